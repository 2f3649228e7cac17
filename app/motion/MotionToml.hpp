#pragma once

#include <string>
#include <vector>

#include "ortung/base/Parameters.hpp"
#include "ortung/study/MotionLearner.hpp"

namespace ortung::app {

/// The file of `ortung learn-motion`: a table [motion] with comments, which readMotionFile() reads.
/// @param sources that it was learned from, for a comment
/// @param base where learning began: says the plugin
/// @param settings as of MotionModel::settings(), with delay_s
std::string motionToml(const std::vector<std::string>& sources, const LearnedMotion& result,
                       const Parameters& base, const Parameters& settings);

}  // namespace ortung::app

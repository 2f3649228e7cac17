#pragma once

#include <string>
#include <vector>

#include "ortung/base/Parameters.hpp"
#include "ortung/study/MotionLearner.hpp"

namespace ortung::app {

/// Returns the file of `ortung learn-motion`: a table [motion] with comments, for readMotionFile().
/// @param sources sources from which it was learned, for a comment
/// @param base settings with which learning began; they name the plugin
/// @param settings settings of MotionModel::settings(), with delay_s
std::string motionToml(const std::vector<std::string>& sources, const LearnedMotion& result,
                       const Parameters& base, const Parameters& settings);

}  // namespace ortung::app

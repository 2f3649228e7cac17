#pragma once

#include <filesystem>
#include <string>

#include "Progress.hpp"
#include "ortung/mcl/MotionLearner.hpp"

namespace ortung::app {

/// Odometry and ground truth of a source.
/// @param text "KIND:PATH?key=value", or just the path of a record
/// @param from, to which part of the log, as shares of its time in [0, 1]
/// @throws std::runtime_error if it lacks one of them; as openSource()
MotionLog readMotionLog(const std::string& text, const std::filesystem::path& robotFile,
                        double from, double to, Progress& progress);

}  // namespace ortung::app

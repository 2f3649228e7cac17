#pragma once

#include <filesystem>
#include <string>

#include "MotionGrid.hpp"
#include "Progress.hpp"
#include "ortung/study/MotionLearner.hpp"

namespace ortung::app {

/// Odometry and ground truth of a source.
/// @param text "KIND:PATH?key=value", or just the path of a record
/// @param from, to which part of the log, as shares of its time in [0, 1]
/// @param model whose odometryAt() is the odometry to learn from; used up
/// @throws std::runtime_error if it lacks one of them; as openSourceArgument()
MotionLog readMotionLog(const std::string& text, const std::filesystem::path& robotFile,
                        double from, double to, MotionModel& model, Progress& progress);

/// Commanded velocities and ground truth of a source.
/// @param from "velocities" or "motion_data" of odometry, or "auto"
/// @param fromVelocities out: which it was
/// @throws as readMotionLog()
CommandLog readCommandLog(const std::string& text, const std::filesystem::path& robotFile,
                          const std::string& from, bool& fromVelocities, Progress& progress);

}  // namespace ortung::app

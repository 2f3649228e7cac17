#pragma once

#include <filesystem>
#include <string>

#include "MotionGrid.hpp"
#include "Progress.hpp"
#include "ortung/study/MotionLearner.hpp"

namespace ortung::app {

/// Reads odometry and ground truth of a source.
/// @param text source, "KIND:PATH?key=value", or the path of a record
/// @param from, to part of the log that is used, as shares of its time in [0, 1]
/// @param model its odometryAt() returns the odometry; the model is changed
/// @throws std::runtime_error if the source lacks one of them; else as openSourceArgument()
MotionLog readMotionLog(const std::string& text, const std::filesystem::path& robotFile,
                        double from, double to, MotionModel& model, Progress& progress);

/// Reads commanded velocities and ground truth of a source.
/// @param from where odometry has the commands: "velocities", "motion_data" or "auto"
/// @param fromVelocities out: whether they were its velocities
/// @throws as readMotionLog()
CommandLog readCommandLog(const std::string& text, const std::filesystem::path& robotFile,
                          const std::string& from, bool& fromVelocities, Progress& progress);

}  // namespace ortung::app

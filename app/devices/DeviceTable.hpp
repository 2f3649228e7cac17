#pragma once

#include <optional>
#include <string>
#include <vector>

#include "ortung/devices/DeviceHealth.hpp"
#include "ortung/mcl/PoseEstimate.hpp"

namespace ortung::app {

/// Returns a table with a line for each device: its state, its rate, the age of its newest reading
/// and its problem; then the pose, if there is one.
/// @param withoutOdometry time since the newest odometry [s]; nothing: it is not missing
std::string deviceTable(const std::vector<DeviceStatus>& devices,
                        const std::optional<PoseEstimate>& estimate,
                        std::optional<double> withoutOdometry = std::nullopt);

}  // namespace ortung::app

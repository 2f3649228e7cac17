#pragma once

#include <optional>
#include <string>
#include <vector>

#include "ortung/devices/DeviceHealth.hpp"
#include "ortung/mcl/PoseEstimate.hpp"

namespace ortung::app {

/// Returns a table with a line for each device: its state, its rate, the age of its newest reading
/// and its problem; then the pose, if there is one.
std::string deviceTable(const std::vector<DeviceStatus>& devices,
                        const std::optional<PoseEstimate>& estimate);

}  // namespace ortung::app

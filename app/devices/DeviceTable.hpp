#pragma once

#include <optional>
#include <string>
#include <vector>

#include "ortung/devices/DeviceHealth.hpp"
#include "ortung/mcl/PoseEstimate.hpp"

namespace ortung::app {

/// A line for each device: how it is, how often it measures, how old its newest reading is, and
/// what was wrong; then the pose, if there is one.
std::string deviceTable(const std::vector<DeviceStatus>& devices,
                        const std::optional<PoseEstimate>& estimate);

}  // namespace ortung::app

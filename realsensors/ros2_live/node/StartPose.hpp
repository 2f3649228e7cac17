#pragma once

#include <optional>
#include <string>

#include "ortung/base/Pose2.hpp"

namespace ortung::ros2 {

/// Reads what follows an option --start: x [m], y [m] and heading [degrees] with commas between
/// them. @returns nothing for other texts
std::optional<Pose2> parseStartPose(const std::string& text);

}  // namespace ortung::ros2

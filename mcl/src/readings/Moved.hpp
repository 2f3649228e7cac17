#pragma once

#include <cmath>

#include "ortung/base/Pose2.hpp"
#include "ortung/mcl/MclConfig.hpp"

namespace ortung {

/// Returns whether the robot has moved by as much as makes the next reading count.
inline bool hasMoved(const MclConfig& config, const Pose2& from, const Pose2& to) {
  const Pose2 change = inverse(from) * to;
  return std::hypot(change.x, change.y) >= config.minDistance ||
         std::abs(change.theta) >= config.minRotation;
}

}  // namespace ortung

#pragma once

#include <cmath>

#include "ortung/base/Pose2.hpp"

namespace ortung {

/// Motion without readings is followed in pieces of this size: the noise of a long way that leads
/// back to where it began is not that of no way at all.
inline bool isPiece(const Pose2& change) {
  constexpr double kMetres = 0.1;
  constexpr double kRadians = 0.1;
  return std::hypot(change.x, change.y) >= kMetres || std::abs(change.theta) >= kRadians;
}

}  // namespace ortung

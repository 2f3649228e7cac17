#pragma once

#include <cmath>

#include "MotionTuning.hpp"
#include "ortung/base/Pose2.hpp"

namespace ortung {

/// Motion without readings is followed in pieces of this size: the noise of a long way that leads
/// back to where it began is not that of no way at all.
inline bool isPiece(const Pose2& change) {
  return std::hypot(change.x, change.y) >= tuning::pieces::kMetres ||
         std::abs(change.theta) >= tuning::pieces::kRadians;
}

}  // namespace ortung

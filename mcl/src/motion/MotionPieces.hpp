#pragma once

#include <cmath>

#include "MotionTuning.hpp"
#include "ortung/base/Pose2.hpp"

namespace ortung {

/// Returns whether a change of pose is large enough to move the samples by it. Motion without
/// readings is followed in pieces of this size, since the noise of a long path that leads back to
/// its beginning is not that of no motion at all.
inline bool isPiece(const Pose2& change) {
  return std::hypot(change.x, change.y) >= tuning::pieces::kSize ||
         std::abs(change.theta) >= tuning::pieces::kSize;
}

}  // namespace ortung

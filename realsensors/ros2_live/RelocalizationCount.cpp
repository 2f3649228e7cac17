#include "RelocalizationCount.hpp"

#include <cmath>

#include "ortung/base/Angles.hpp"

namespace ortung::ros2 {
namespace {

// What PoseEstimate::relocalizations promises.
constexpr double kMetres = 0.10;
constexpr double kRadians = 3.0 * kDegree;

bool isLarge(const Pose2& step) {
  return std::hypot(step.x, step.y) > kMetres || std::abs(step.theta) > kRadians;
}

}  // namespace

bool RelocalizationCount::follow(const PoseEstimate& filter, const std::optional<Placed>& placed) {
  bool hasRisen = filter.relocalizations != ofFilter_;
  if (hasRisen) {
    // One that has begun anew without our knowledge is one step, whatever its count was.
    count_ += filter.relocalizations > ofFilter_ ? filter.relocalizations - ofFilter_ : 1;
    cause_ = filter.relocalization;
    ofFilter_ = filter.relocalizations;
  }
  if (!placed) return hasRisen;
  if (odomInMap_ && !hasRisen) {
    const Pose2 before = *odomInMap_ * placed->robotInOdom;
    hasRisen = isLarge(inverse(before) * (placed->odomInMap * placed->robotInOdom));
    if (hasRisen) {
      ++count_;
      cause_ = Relocalization::kReadings;
    }
  }
  odomInMap_ = placed->odomInMap;
  return hasRisen;
}

}  // namespace ortung::ros2

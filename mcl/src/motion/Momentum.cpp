#include "Momentum.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "BeliefTuning.hpp"

namespace ortung {
namespace {

using tuning::common::kOutlier;

/// Returns the gain: the share of a measured change that counts.
double known(double drifted, double open) {
  return drifted > 0.0 ? drifted / (drifted + open) : 0.0;
}

}  // namespace

void Momentum::follow(const PoseEstimate& seen, Timestamp stamp) {
  const Seen now{seen.pose, stamp, positionVariance(seen.covariance) / 2.0,
                 headingVariance(seen.covariance)};
  const std::optional<Seen> before = std::exchange(last_, now);
  const double seconds = before ? toSeconds(stamp - before->stamp) : 0.0;
  perSecond_ = {};
  lasts_ = 0.0;
  if (seconds <= 0.0) return;
  const Pose2 change = inverse(before->pose) * now.pose;
  if (std::hypot(change.x, change.y) > kOutlier * config_.driftMetres * seconds ||
      std::abs(change.theta) > kOutlier * config_.driftRadians * seconds)
    return;
  // The displacement in the robot's frame halfway through the turn.
  const Pose2 half = Pose2{0.0, 0.0, -change.theta / 2.0} * Pose2{change.x, change.y, 0.0};
  const double way =
      known(config_.driftMetres * config_.driftMetres * seconds, before->open + now.open);
  const double turn =
      known(config_.driftRadians * config_.driftRadians * seconds, before->openTurn + now.openTurn);
  perSecond_ = {way * half.x / seconds, way * half.y / seconds, turn * change.theta / seconds};
  lasts_ = seconds;
}

Pose2 Momentum::changeAt(Timestamp stamp) const {
  if (!last_ || stamp <= last_->stamp) return {};
  const double seconds = std::min(toSeconds(stamp - last_->stamp), lasts_);
  const double turn = perSecond_.theta * seconds;
  return Pose2{0.0, 0.0, turn / 2.0} *
         Pose2{perSecond_.x * seconds, perSecond_.y * seconds, turn / 2.0};
}

}  // namespace ortung

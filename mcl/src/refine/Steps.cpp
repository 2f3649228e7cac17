#include "Steps.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "RefineTuning.hpp"

namespace ortung {
namespace {

using namespace tuning::steps;

// What PoseEstimate::relocalizations promises.
constexpr double kMetres = 0.10;
constexpr double kRadians = 3.0 * std::numbers::pi / 180.0;

bool isLarge(const Pose2& step) {
  return std::hypot(step.x, step.y) > kMetres || std::abs(step.theta) > kRadians;
}

}  // namespace

void Steps::follow(const Pose2& pose, Timestamp stamp) {
  const std::optional<Pose2> before = std::exchange(expected_, std::nullopt);
  const Relocalization cause = std::exchange(cause_, Relocalization::kNone);
  if (!before) return;
  const Pose2 step = inverse(pose) * *before;
  if (isLarge(step))
    return begin(cause == Relocalization::kNone ? Relocalization::kReadings : cause);
  offset_ = step * offsetAt(stamp);
  since_ = stamp;
}

void Steps::begin(Relocalization cause) {
  ++count_;
  newest_ = cause;
  offset_ = {};
  expected_.reset();
  cause_ = Relocalization::kNone;
}

void Steps::apply(PoseEstimate& estimate) const {
  estimate.smooth = estimate.pose * offsetAt(estimate.stamp);
  estimate.relocalizations = count_;
  estimate.relocalization = newest_;
}

Pose2 Steps::offsetAt(Timestamp stamp) const {
  const double left = std::exp(-std::max(0.0, toSeconds(stamp - since_)) / kBlend);
  return {left * offset_.x, left * offset_.y, left * offset_.theta};
}

}  // namespace ortung

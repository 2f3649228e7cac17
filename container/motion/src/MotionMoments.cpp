#include "ortung/motion/MotionMoments.hpp"

#include <typeinfo>

#include "ortung/motion/OdometryMotion.hpp"

namespace ortung {

namespace {

/// Greatest variance of headings [rad^2] in which hardly any sample wraps, also if some slip.
constexpr double kMostTurned = 0.25;

std::optional<MotionChange> knownOf(const MotionModel& motion, const Pose2& odometryChange) {
  if (const auto* known = dynamic_cast<const MotionMoments*>(&motion))
    return known->moments(odometryChange);
  // A class that derives from it may move samples in another way.
  if (typeid(motion) != typeid(OdometryMotion)) return std::nullopt;
  const auto& odometry = static_cast<const OdometryMotion&>(motion);
  return expectedChange(odometry.noise(), odometry.correction(), odometryChange);
}

}  // namespace

MotionMoments::~MotionMoments() = default;

std::optional<MotionChange> momentsOf(const MotionModel& motion, const Pose2& odometryChange) {
  const std::optional<MotionChange> known = knownOf(motion, odometryChange);
  if (known && headingVariance(known->covariance) > kMostTurned) return std::nullopt;
  return known;
}

}  // namespace ortung

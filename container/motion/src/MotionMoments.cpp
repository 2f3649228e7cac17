#include "ortung/motion/MotionMoments.hpp"

#include <typeinfo>

#include "ortung/motion/OdometryMotion.hpp"

namespace ortung {

MotionMoments::~MotionMoments() = default;

std::optional<MotionChange> momentsOf(const MotionModel& motion, const Pose2& odometryChange) {
  if (const auto* known = dynamic_cast<const MotionMoments*>(&motion))
    return known->moments(odometryChange);
  // A class that derives from it may move samples in another way.
  if (typeid(motion) != typeid(OdometryMotion)) return std::nullopt;
  const auto& odometry = static_cast<const OdometryMotion&>(motion);
  return expectedChange(odometry.noise(), odometry.correction(), odometryChange);
}

}  // namespace ortung

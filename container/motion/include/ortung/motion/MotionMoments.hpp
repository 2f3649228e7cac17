#pragma once

#include <optional>

#include "ortung/base/Export.hpp"
#include "ortung/base/Pose2.hpp"
#include "ortung/base/PoseCovariance.hpp"

namespace ortung {

/// Mean and covariance of a change of pose, in the robot's frame before it.
struct MotionChange {
  Pose2 mean;
  PoseCovariance covariance{};
};

class MotionModel;

/// What a motion model may know in closed form besides sampling. Without it the same is estimated
/// from many samples, which takes as long as moving a thousand of them. OdometryMotion does not
/// derive from it, so that no class inherits moments while it moves samples in another way.
class ORTUNG_API MotionMoments {
 public:
  virtual ~MotionMoments();
  /// Returns mean and covariance of the samples that sampleMotion() would give for one that stands
  /// at the origin; nothing if they are not known.
  /// @param odometryChange motion in the robot's old frame
  virtual std::optional<MotionChange> moments(const Pose2& odometryChange) const = 0;
};

/// Returns the moments of a model that has MotionMoments or is an OdometryMotion itself. Nothing
/// for others, and where headings are so unsure that samples' may wrap.
/// @param odometryChange motion in the robot's old frame
ORTUNG_API std::optional<MotionChange> momentsOf(const MotionModel& motion,
                                                 const Pose2& odometryChange);

}  // namespace ortung

#pragma once

#include <cstddef>
#include <cstdint>

#include "ortung/base/Export.hpp"
#include "ortung/base/PoseCovariance.hpp"
#include "ortung/mcl/PoseEstimate.hpp"
#include "ortung/motion/MotionModel.hpp"
#include "ortung/motion/MotionMoments.hpp"

namespace ortung {

/// Returns the change of pose that a motion model predicts from odometry's change: in closed form
/// if it knows its moments, else estimated from this many samples.
MotionChange changeOf(const MotionModel& motion, const Pose2& odometryChange, std::size_t samples,
                      std::uint64_t seed, std::uint64_t stream);
/// The same from as many samples as a prediction takes; without motion there is no change.
ORTUNG_API MotionChange changeOf(const MotionModel& motion, const Pose2& odometryChange,
                                 std::uint64_t seed, std::uint64_t stream);

/// Predicts an estimate by odometry, as an extended Kalman filter does: the pose changes by the
/// mean of the motion model, and the covariance is propagated (the uncertain heading makes the
/// position uncertain) and grows by the model's noise.
/// @param odometryChange odometry's change since the estimate, in the robot's frame at the estimate
/// @param seed, stream the random numbers depend on these alone
ORTUNG_API PoseEstimate carriedOn(const PoseEstimate& estimate, const MotionModel& motion,
                                  const Pose2& odometryChange, std::uint64_t seed,
                                  std::uint64_t stream);

/// The same with a change that is known already. @param noise factor of its covariance
ORTUNG_API PoseEstimate carriedOn(const PoseEstimate& estimate, const MotionChange& change,
                                  double noise = 1.0);

/// Returns the estimate after a change of pose without noise, in the robot's own frame.
ORTUNG_API PoseEstimate moved(PoseEstimate estimate, const Pose2& change);

}  // namespace ortung

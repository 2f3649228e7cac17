#pragma once

#include <cstddef>
#include <cstdint>

#include "ortung/base/Export.hpp"
#include "ortung/base/PoseCovariance.hpp"
#include "ortung/mcl/PoseEstimate.hpp"
#include "ortung/motion/MotionModel.hpp"

namespace ortung {

/// Mean and covariance of a change of pose, in the robot's old frame.
struct MotionChange {
  Pose2 mean;
  PoseCovariance covariance{};
};

/// What a motion model makes of odometry's change, of so many samples.
MotionChange changeOf(const MotionModel& motion, const Pose2& odometryChange, std::size_t samples,
                      std::uint64_t seed, std::uint64_t stream);

/// What is known of a robot after moving on: its pose by the mean of what the motion model makes of
/// odometry's change, its covariance by that of the heading before and the model's noise.
/// @param odometryChange since the estimate, in the robot's old frame
/// @param seed, stream random numbers depend on these alone
ORTUNG_API PoseEstimate carriedOn(const PoseEstimate& estimate, const MotionModel& motion,
                                  const Pose2& odometryChange, std::uint64_t seed,
                                  std::uint64_t stream);

/// What is known of a pose after an exact change of it in its own frame.
ORTUNG_API PoseEstimate moved(PoseEstimate estimate, const Pose2& change);

}  // namespace ortung

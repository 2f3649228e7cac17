#pragma once

#include <cstdint>

#include "ortung/base/Export.hpp"
#include "ortung/base/Pose2.hpp"
#include "ortung/motion/MotionModel.hpp"

namespace ortung {

/// Moves samples as MotionModel::sampleMotion() does, but by less or more noise than the model's,
/// where odometry is known to be better or worse. Every eighth sample gets at least all of it,
/// since wheels may slip at any moment.
/// @param mean what the model makes of @p change in the mean, in the robot's frame before it
/// @param noise variance, as a factor of the model's, positive
ORTUNG_API void sampleMotion(const MotionModel& motion, const MovableSamples& samples,
                             const Pose2& change, const Pose2& mean, double noise,
                             std::uint64_t seed, std::uint64_t stream, std::uint64_t first);

}  // namespace ortung

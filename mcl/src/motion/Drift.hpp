#pragma once

#include <cstdint>

#include "ortung/base/Export.hpp"
#include "ortung/base/Pose2.hpp"
#include "ortung/base/Time.hpp"
#include "ortung/mcl/MclConfig.hpp"
#include "ortung/mcl/SampleSet.hpp"
#include "ortung/motion/MotionModel.hpp"

namespace ortung {

/// Returns the time over which process noise acts [s]; 0 if the clock was set back meanwhile.
ORTUNG_API double driftSeconds(Timestamp since, Timestamp until);

/// Moves samples without odometry: by the expected change of pose, plus process noise whose
/// variance grows with time (driftMetres, driftRadians of @p config).
/// @param ahead expected change of pose, in the robot's frame before it
/// @param seconds time since they were moved last, not negative
/// @param stream, first as in MotionModel::sampleMotion
ORTUNG_API void drift(const MclConfig& config, const MovableSamples& samples, const Pose2& ahead,
                      double seconds, std::uint64_t stream, std::uint64_t first);

/// Where a robot may be while its odometry is not trusted: half of the samples are moved by
/// odometry, the other half by process noise.
struct Spread {
  SampleSet samples;
  std::size_t drifted = 0;  ///< samples from this one on were moved by process noise
};
/// @param moved samples that odometry has moved since the belief was weighed
/// @param anchor the belief as it was then
/// @param ahead, seconds as in drift()
/// @param n least number of samples in each half
ORTUNG_API Spread spread(const MclConfig& config, const SampleSet& moved, const SampleSet& anchor,
                         const Pose2& ahead, double seconds, std::size_t n, std::uint64_t stream);

}  // namespace ortung

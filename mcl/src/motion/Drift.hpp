#pragma once

#include <cstdint>

#include "ortung/base/Export.hpp"
#include "ortung/base/Pose2.hpp"
#include "ortung/base/Time.hpp"
#include "ortung/mcl/MclConfig.hpp"
#include "ortung/mcl/SampleSet.hpp"
#include "ortung/motion/MotionModel.hpp"

namespace ortung {

/// Time in which a robot may have drifted; none if the clock was set back meanwhile [s].
ORTUNG_API double driftSeconds(Timestamp since, Timestamp until);

/// Moves samples as a robot moves of whose motion nothing is known: anywhere, the variances growing
/// with time (driftMetres, driftRadians of @p config), around where it would be if it went on.
/// @param ahead the change of its pose then, in its own frame
/// @param seconds since they were moved last, not negative
/// @param stream, first as of MotionModel::sampleMotion
ORTUNG_API void drift(const MclConfig& config, const MovableSamples& samples, const Pose2& ahead,
                      double seconds, std::uint64_t stream, std::uint64_t first);

/// Where a robot may be whose odometry is not trusted: one half of the samples as odometry moved
/// them, the other half drifted.
struct Spread {
  SampleSet samples;
  std::size_t drifted = 0;  ///< samples from this one on have drifted
};
/// @param moved by odometry since the belief was weighed
/// @param anchor the belief as it was then
/// @param ahead, seconds as of drift()
/// @param n samples of each half, at least
ORTUNG_API Spread spread(const MclConfig& config, const SampleSet& moved, const SampleSet& anchor,
                         const Pose2& ahead, double seconds, std::size_t n, std::uint64_t stream);

}  // namespace ortung

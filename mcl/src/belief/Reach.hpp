#pragma once

#include <span>

#include "ortung/base/Export.hpp"
#include "ortung/mcl/PoseEstimate.hpp"
#include "ortung/mcl/SampleSet.hpp"

namespace ortung {

/// Returns how far from a pose the belief reaches: at most the share @p rest of it is farther away,
/// in position and in heading each.
/// @param weights normalized
ORTUNG_API PoseDistance reachOf(const SampleView& samples, std::span<const double> weights,
                                const Pose2& pose, double rest);

}  // namespace ortung

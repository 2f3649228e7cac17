#pragma once

#include "ortung/base/Export.hpp"
#include "ortung/base/Pose2.hpp"
#include "ortung/tables/SurfaceField.hpp"

namespace ortung {

/// Distance from a pose straight ahead to the first surface [m]; @p maxRange if there is none. A
/// surface is met where the ray crosses its line within the cell that its ends were in, or passes
/// its spot.
ORTUNG_API double rangeAlong(const SurfaceField& surfaces, const Pose2& ray, double maxRange);

}  // namespace ortung

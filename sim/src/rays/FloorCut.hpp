#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>

#include "ortung/sim_api/World.hpp"
#include "ortung/tables/Building.hpp"

namespace ortung {

/// Ends rays where they leave the strip of their floor: what stands on another floor is not there
/// for them.
inline void cutAtFloor(const Building& building, const RayFan& fan, std::span<float> ranges) {
  const Floor& floor = building.floorOf(fan.x);
  const double flat = std::cos(fan.elevation);
  for (std::size_t i = 0; i < ranges.size(); ++i) {
    const double along = flat * std::cos(fan.firstAngle + static_cast<double>(i) * fan.angleStep);
    const double end = along > 0.0 ? floor.xHigh : floor.xLow;
    if (static_cast<double>(ranges[i]) * std::abs(along) > std::abs(end - fan.x))
      ranges[i] = static_cast<float>(fan.maxRange);
  }
}

/// Returns how far the strip of a place's floor reaches at least [m].
inline double toBorder(const Building& building, double x) {
  const Floor& floor = building.floorOf(x);
  return std::min(x - floor.xLow, floor.xHigh - x);
}

}  // namespace ortung

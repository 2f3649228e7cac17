#pragma once

#include <span>
#include <vector>

#include "WorldModel.hpp"
#include "ortung/sim_api/World.hpp"

namespace ortung {

/// Shortens the ranges of the cones in which a wall of a map is nearer. Maps are tested by rays:
/// for a map at the height of the apex by horizontal ones, so dense that no cell lies between two.
void castConesAtMaps(const World& world, const std::vector<GridBody>& maps, const ConeFan& fan,
                     RobotNumber ignore, std::span<float> ranges);

}  // namespace ortung

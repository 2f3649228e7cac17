#pragma once

#include <span>
#include <vector>

#include "WorldModel.hpp"
#include "ortung/sim_api/World.hpp"

namespace ortung {

/// Shortens those ranges of the cones in which a wall of a map is nearer. Maps are met by rays: of
/// a map that is as high as the apex, level ones so dense that no cell of it lies between two.
void castConesAtMaps(const World& world, const std::vector<GridBody>& maps, const ConeFan& fan,
                     RobotNumber ignore, std::span<float> ranges);

}  // namespace ortung

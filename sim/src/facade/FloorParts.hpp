#pragma once

#include <algorithm>

#include "ortung/sim/SimWorld.hpp"
#include "ortung/tables/FieldParts.hpp"

namespace ortung {

/// Returns the parts of a world's floor that walls separate.
/// @param whole cells in which the robot can stand, see SimWorld::region()
inline FieldParts floorParts(const SimWorld& world, const FieldRegion& whole,
                             const RobotSize& robot) {
  // Small, but too large to slip through walls that are thinner than a cell.
  const RobotSize small{std::min(robot.radius, whole.grid.cell / 2.0), robot.height};
  return {whole, world.region(whole.grid.cell, small).standable};
}

/// Returns the index of the part in which the robot most likely is. @pre there is a part
inline std::size_t mainPart(const SimWorld& world, const FieldParts& parts) {
  // A map marks the outside as unknown, and no robot is there.
  return parts.main(world.solids().walls.empty());
}

}  // namespace ortung

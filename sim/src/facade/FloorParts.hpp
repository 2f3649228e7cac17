#pragma once

#include <algorithm>

#include "ortung/sim/SimWorld.hpp"
#include "ortung/tables/FieldParts.hpp"

namespace ortung {

/// Returns a world's cells through which one gets from one cell in which the robot can stand to the
/// next: a small robot's, but too large to slip through walls that are thinner than a cell.
inline FieldRegion passableIn(const SimWorld& world, const FieldRegion& whole,
                              const RobotSize& robot) {
  return world.region(whole.grid.cell,
                      {std::min(robot.radius, whole.grid.cell / 2.0), robot.height});
}

/// Returns the parts of a world's floor that walls separate.
/// @param whole cells in which the robot can stand, see SimWorld::region()
inline FieldParts floorParts(const SimWorld& world, const FieldRegion& whole,
                             const RobotSize& robot) {
  return {whole, passableIn(world, whole, robot).standable};
}

/// Returns the index of the part in which the robot most likely is. @pre there is a part
inline std::size_t mainPart(const SimWorld& world, const FieldParts& parts) {
  // A map marks the outside as unknown, and no robot is there.
  return parts.main(world.solids().walls.empty());
}

}  // namespace ortung

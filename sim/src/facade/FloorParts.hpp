#pragma once

#include <algorithm>

#include "ortung/sim/SimWorld.hpp"
#include "ortung/tables/FieldParts.hpp"

namespace ortung {

/// The parts of a world's floor that walls keep apart.
/// @param whole where the robot can stand, as the world says
inline FieldParts floorParts(const SimWorld& world, const FieldRegion& whole,
                             const RobotSize& robot) {
  // As small as does not slip through walls that are thinner than a cell.
  const RobotSize small{std::min(robot.radius, whole.grid.cell / 2.0), robot.height};
  return {whole, world.region(whole.grid.cell, small).standable};
}

/// The one that a robot most likely is in. @pre there is a part
inline std::size_t mainPart(const SimWorld& world, const FieldParts& parts) {
  // A map knows where it is outside: nobody stands on what is not known.
  return parts.main(world.solids().walls.empty());
}

}  // namespace ortung

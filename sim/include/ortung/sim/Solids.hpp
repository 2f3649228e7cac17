#pragma once

#include <vector>

#include "ortung/sim/Primitive.hpp"
#include "ortung/sim_api/World.hpp"

namespace ortung {

/// A straight piece of an upright wall.
struct WallSegment {
  Point2 from;         ///< [m]
  Point2 to;           ///< [m]
  double zLow = 0.0;   ///< [m]
  double zHigh = 0.0;  ///< [m]
};

/// What bodies can run into, of what does not move.
struct Solids {
  Box2 bounds;  ///< nothing leaves the field
  std::vector<Primitive> primitives;
  std::vector<WallSegment> walls;  ///< outlines of maps
};

}  // namespace ortung

#pragma once

#include <vector>

#include "ortung/sim/Primitive.hpp"
#include "ortung/sim_api/World.hpp"

namespace ortung {

/// A straight piece of an upright wall.
struct WallSegment {
  Point2 from;         ///< one end [m]
  Point2 to;           ///< other end [m]
  double zLow = 0.0;   ///< height of its bottom [m]
  double zHigh = 0.0;  ///< height of its top [m]
};

/// The fixed obstacles that bodies can collide with.
struct Solids {
  Box2 bounds;  ///< nothing leaves the field
  std::vector<Primitive> primitives;
  std::vector<WallSegment> walls;  ///< outlines of maps
};

}  // namespace ortung

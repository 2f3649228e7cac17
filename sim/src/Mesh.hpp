#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "WorldModel.hpp"

namespace ortung {

/// An upright cylinder.
struct Cylinder {
  Point2 centre;        ///< [m]
  double radius = 0.0;  ///< [m]
  double zLow = 0.0;    ///< [m]
  double zHigh = 0.0;   ///< [m]
};

/// What rays can hit, relative to a middle of its own, so that single precision serves far from the
/// field's origin too.
struct Mesh {
  Point2 middle;                                       ///< [m], field frame
  std::vector<std::array<float, 3>> vertices;          ///< [m], relative to middle
  std::vector<std::array<std::uint32_t, 3>> triangles; ///< indices of vertices
  std::vector<Cylinder> cylinders;                     ///< field frame
};

/// Extrudes everything solid: circles to cylinders, all else to triangles.
/// @throws std::length_error when there are more than 2^21 walls
Mesh makeMesh(const WorldModel& world);

}  // namespace ortung

#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "WorldModel.hpp"

namespace ortung {

/// An upright cylinder with an elliptic base, in the field frame.
struct RoundBody {
  Point2 centre;       ///< centre of the base [m]
  double halfX = 0.0;  ///< half its size along its own x axis [m]
  double halfY = 0.0;  ///< half its size along its own y axis [m]
  double angle = 0.0;  ///< direction of its own x axis [rad]
  double zLow = 0.0;   ///< height of its bottom [m]
  double zHigh = 0.0;  ///< height of its top [m]
};

struct Triangles {
  std::vector<std::array<float, 3>> vertices;  ///< vertices relative to the mesh's middle [m]
  std::vector<std::array<std::uint32_t, 3>> corners;  ///< indices of each triangle's vertices
};

/// Everything that rays can hit, relative to a middle of its own, so that single precision is also
/// enough far from the field's origin.
struct Mesh {
  Point2 middle;    ///< origin of the mesh in the field frame [m]
  Triangles walls;  ///< vertical triangles
  Triangles caps;   ///< horizontal triangles, which only inclined rays meet
  std::vector<RoundBody> round;
  /// Triangles of `walls` from this one on are outlines of maps whose surfaces lie `depth` behind.
  struct Depth {
    std::size_t firstTriangle = 0;
    double depth = 0.0;  ///< distance of the surface behind the outline [m]
  };
  std::vector<Depth> depths;  ///< one entry per map, in the order of triangles; empty if all are 0
};

/// Calls found(from, to) for every straight piece of the edges between occupied cells and others.
void forOutline(const GridBody& body,
                const std::function<void(const Point2&, const Point2&)>& found);

/// Extrudes everything solid: circles and ellipses to round bodies, all else to triangles.
/// @throws std::length_error when there are more than 2^21 walls
Mesh makeMesh(const WorldModel& world);

}  // namespace ortung

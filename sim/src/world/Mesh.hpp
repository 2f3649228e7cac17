#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "WorldModel.hpp"

namespace ortung {

/// An upright cylinder with an elliptic base, in the field frame.
struct RoundBody {
  Point2 centre;       ///< [m]
  double halfX = 0.0;  ///< half the axis along its own x axis [m]
  double halfY = 0.0;  ///< [m]
  double angle = 0.0;  ///< of its own x axis [rad]
  double zLow = 0.0;   ///< [m]
  double zHigh = 0.0;  ///< [m]
};

struct Triangles {
  std::vector<std::array<float, 3>> vertices;         ///< [m], relative to the mesh's middle
  std::vector<std::array<std::uint32_t, 3>> corners;  ///< of vertices
};

/// What rays can hit, relative to a middle of its own, so that single precision serves far from the
/// field's origin too.
struct Mesh {
  Point2 middle;    ///< [m], field frame
  Triangles walls;  ///< upright
  Triangles caps;   ///< level, so that only rays that rise or fall meet them
  std::vector<RoundBody> round;
  /// Triangles of `walls` from this one on are outlines of maps whose surfaces lie `depth` behind.
  struct Depth {
    std::size_t firstTriangle = 0;
    double depth = 0.0;  ///< [m]
  };
  std::vector<Depth> depths;  ///< one a map, in the order of triangles; empty if all are 0
};

/// Calls for every straight piece of the edges between occupied cells and others.
void forOutline(const GridBody& body,
                const std::function<void(const Point2&, const Point2&)>& found);

/// Extrudes everything solid: circles and ellipses to round bodies, all else to triangles.
/// @throws std::length_error when there are more than 2^21 walls
Mesh makeMesh(const WorldModel& world);

}  // namespace ortung

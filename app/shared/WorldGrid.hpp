#pragma once

#include <cstddef>
#include <string>

#include "ortung/sim/SimWorld.hpp"

namespace ortung::app {

/// A grid map with the values of map_server, the bottom row first.
struct WorldGrid {
  static constexpr char kOccupied = 0;
  static constexpr char kUnknown = static_cast<char>(205);
  static constexpr char kFree = static_cast<char>(254);
  double cell = 0.0;     ///< size of a cell [m]
  double originX = 0.0;  ///< lower left corner of cell (0, 0) [m], a multiple of the cell size
  double originY = 0.0;  ///< its y coordinate [m]
  std::size_t columns = 0;
  std::size_t rows = 0;
  std::string cells;
};

/// Draws the map that a scanner at a height would make: surfaces are occupied, open space is free,
/// and the inside of solids is unknown.
/// @param cell size of a cell, at least 0.005 [m]
/// @param height height over the floor [m]
/// @throws UsageError for more than 2^26 cells
WorldGrid drawGrid(const SimWorld& world, double cell, double height);

}  // namespace ortung::app

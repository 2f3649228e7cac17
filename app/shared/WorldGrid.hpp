#pragma once

#include <cstddef>
#include <string>

#include "ortung/sim/SimWorld.hpp"

namespace ortung::app {

/// Cells as a map of map_server has them, the bottom row first.
struct WorldGrid {
  static constexpr char kOccupied = 0;
  static constexpr char kUnknown = static_cast<char>(205);
  static constexpr char kFree = static_cast<char>(254);
  double cell = 0.0;     ///< edge [m]
  double originX = 0.0;  ///< of cell (0, 0), its lower left corner [m]; a multiple of the edge
  double originY = 0.0;
  std::size_t columns = 0;
  std::size_t rows = 0;
  std::string cells;
};

/// What a scanner sees at that height: surfaces are occupied, what is free is free, and what it
/// can't look into (or over) is not known.
/// @param cell edge of a cell, at least 0.005 @param height over the floor [m]
/// @throws UsageError for more than 2^26 cells
WorldGrid drawGrid(const SimWorld& world, double cell, double height);

}  // namespace ortung::app

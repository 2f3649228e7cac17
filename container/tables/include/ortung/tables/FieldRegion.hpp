#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "ortung/base/Export.hpp"
#include "ortung/tables/Building.hpp"

namespace ortung {

/// Square cells over the field. Cell (column, row) covers
/// [originX + column * cell, originX + (column + 1) * cell) and likewise in y;
/// its index is row * columns + column.
struct FieldGrid {
  double originX = 0.0;  ///< [m], lower left corner
  double originY = 0.0;  ///< [m]
  double cell = 0.1;     ///< edge of a cell [m], positive
  int columns = 0;
  int rows = 0;

  std::size_t size() const {
    return static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows);
  }
  /// Index of the cell that holds the point, or -1 outside (and for NaN).
  std::ptrdiff_t cellAt(double x, double y) const {
    const double column = std::floor((x - originX) / cell);
    const double row = std::floor((y - originY) / cell);
    if (!(column >= 0 && row >= 0 && column < columns && row < rows)) return -1;
    return static_cast<std::ptrdiff_t>(row) * columns + static_cast<std::ptrdiff_t>(column);
  }
  double centreX(std::size_t index) const {
    return originX + (static_cast<double>(index % static_cast<std::size_t>(columns)) + 0.5) * cell;
  }
  double centreY(std::size_t index) const {
    return originY + (static_cast<double>(index / static_cast<std::size_t>(columns)) + 0.5) * cell;
  }
  bool operator==(const FieldGrid&) const = default;
};

/// The part of the plane that is learned: where a sensor can be and where the robot can stand.
/// Both masks have grid.size() entries, 0 or 1.
struct FieldRegion {
  FieldGrid grid;
  std::vector<std::uint8_t> open;       ///< whether the cell's centre is not inside anything solid
  std::vector<std::uint8_t> standable;  ///< whether the robot's body fits with its centre here
  /// Standard deviation of the world's surfaces [m]: in maps that are made of cells, the error of
  /// rounding to these, and of who made the map.
  double surfaceSigma = 0.0;
  /// The floors that lie side by side in the field, and the lifts between them; none in most
  /// fields.
  Building building = {};

  /// @throws std::invalid_argument when sizes do not fit, nothing is standable, or as
  ///   Building::check()
  ORTUNG_API void check() const;
};

/// Returns open cells that are about @p spacing [m] apart, in the order of their numbers: from each
/// square block of cells the open one that is nearest to its middle, so that no part of the region
/// is left out. Returns all open cells if the spacing is no wider than two of them.
ORTUNG_API std::vector<std::size_t> openCellsApart(const FieldRegion& region, double spacing);

}  // namespace ortung

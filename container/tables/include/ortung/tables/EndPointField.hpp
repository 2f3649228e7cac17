#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "ortung/base/Export.hpp"
#include "ortung/tables/FieldRegion.hpp"
#include "ortung/tables/TableFile.hpp"

namespace ortung {

/// Distance to the nearest learned end point, by position: the likelihood field (Thrun, Burgard,
/// Fox, "Probabilistic Robotics", section 6.4), but learned by the same sweep as every other
/// table: noise-free end points are marked, then distance-transformed.
/// One byte a cell: kPerCell levels a cell's edge, 255 for "far".
/// Not thread-safe while it is filled; then any number of threads may read it.
class ORTUNG_API EndPointField {
 public:
  static constexpr int kPerCell = 8;  ///< levels per edge of a cell

  /// Covers the region's grid and @p margin beyond it on all sides [m].
  void start(const FieldGrid& grid, double cell, double margin);
  void mark(double x, double y);  ///< marks an end point [m]; ignored outside of the grid
  /// Computes the distances, once all end points are marked.
  void finish();

  const FieldGrid& grid() const { return grid_; }
  /// Returns the level of each cell, row by row: its distance in metresPerLevel(); 255: far.
  std::span<const std::uint8_t> levels() const { return levels_; }
  double metresPerLevel() const { return grid_.cell / kPerCell; }

  /// Writes the field's arrays, whose names begin with @p prefix. @throws TableError
  void save(TableWriter& file, const std::string& prefix) const;
  /// Uses the arrays of a file without copying. @throws TableError
  void load(const std::shared_ptr<const TableFile>& file, const std::string& prefix);

 private:
  FieldGrid grid_;
  std::vector<std::uint8_t> own_;
  std::span<const std::uint8_t> levels_;
  std::shared_ptr<const TableFile> file_;  ///< owner of the memory behind levels_; may be null
};

}  // namespace ortung

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
  static constexpr int kPerCell = 8;  ///< levels a cell

  /// Covers the region's grid and @p margin beyond it on all sides [m].
  void start(const FieldGrid& grid, double cell, double margin);
  void mark(double x, double y);  ///< outside: ignored
  void finish();

  const FieldGrid& grid() const { return grid_; }
  std::span<const std::uint8_t> levels() const { return levels_; }
  double metresPerLevel() const { return grid_.cell / kPerCell; }

  void save(TableWriter& file, const std::string& prefix) const;
  void load(const std::shared_ptr<const TableFile>& file, const std::string& prefix);

 private:
  FieldGrid grid_;
  std::vector<std::uint8_t> own_;
  std::span<const std::uint8_t> levels_;
  std::shared_ptr<const TableFile> file_;  ///< kept for levels_; may be null
};

}  // namespace ortung

#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "ortung/base/Angles.hpp"
#include "ortung/base/Export.hpp"
#include "ortung/tables/FieldRegion.hpp"
#include "ortung/tables/TableFile.hpp"

namespace ortung {

/// A table of expectations by position (x, y), for what does not depend on heading: distances, and
/// directions in the field frame. It has one 16-bit level per cell. Not thread-safe while it is
/// filled; then any number of threads may read it.
class ORTUNG_API CellTable {
 public:
  static constexpr std::uint16_t kNone = 0xFFFF;  ///< no expectation in this cell

  void start(const FieldGrid& grid);
  /// Sets a cell's level; ignored outside of the grid.
  void set(double x, double y, std::uint16_t level);
  std::uint16_t at(double x, double y) const {
    const std::ptrdiff_t cell = grid_.cellAt(x, y);
    return cell < 0 ? kNone : levels_[static_cast<std::size_t>(cell)];
  }
  const FieldGrid& grid() const { return grid_; }
  std::span<const std::uint16_t> levels() const { return levels_; }
  /// Writes one array of shape (rows, columns).
  void save(TableWriter& file, const std::string& name) const;
  void load(const std::shared_ptr<const TableFile>& file, const std::string& name,
            const FieldGrid& grid);

 private:
  FieldGrid grid_;
  /// Levels while the table is filled; empty once loaded from a file.
  std::vector<std::uint16_t> own_;
  std::span<const std::uint16_t> levels_;  ///< levels by cell, in own_ or in the mapped file
  std::shared_ptr<const TableFile> file_;  ///< owner of the memory behind levels_; may be null
};

/// A table of distances [m] by position; one level is metresPerLevel().
/// Not thread-safe while it is filled; then any number of threads may read it.
class ORTUNG_API PositionTable {
 public:
  /// @param maxRange greatest distance that is stored [m]
  explicit PositionTable(double maxRange);
  void start(const FieldGrid& grid) { cells_.start(grid); }
  void learn(double x, double y, double range);
  /// Returns the expected distance [m], or NaN without an expectation.
  float at(double x, double y) const;
  double metresPerLevel() const { return metresPerLevel_; }
  CellTable& cells() { return cells_; }
  const CellTable& cells() const { return cells_; }

 private:
  double metresPerLevel_;
  CellTable cells_;
};

/// A table of directions in the field frame by position; the expected bearing is this minus the
/// heading. One level is 2 pi / 65535. Not thread-safe while it is filled; then any number of
/// threads may read it.
class ORTUNG_API BearingTable {
 public:
  static constexpr double kRadiansPerLevel = kTurn / 65535;
  void start(const FieldGrid& grid) { cells_.start(grid); }
  void learn(double x, double y, double directionInField);
  /// Returns the expected direction in the field frame [rad], or NaN without an expectation.
  float at(double x, double y) const;
  CellTable& cells() { return cells_; }
  const CellTable& cells() const { return cells_; }

 private:
  CellTable cells_;
};

}  // namespace ortung

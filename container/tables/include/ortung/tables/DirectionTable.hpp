#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "ortung/base/Export.hpp"
#include "ortung/tables/FieldRegion.hpp"
#include "ortung/tables/RangeScale.hpp"
#include "ortung/tables/TableFile.hpp"

namespace ortung {

/// Expected range by cell and direction in the field frame, one byte each (RangeScale levels).
/// The ray table: one serves all beams of a scan, since a beam's expectation depends on
/// heading + beam angle. It also serves as the pose table of range cones.
/// Rows exist for open cells only; the directions of a cell lie contiguously, their beginning
/// repeated behind the end so that a run of `longestRun` directions never wraps.
/// Not thread-safe while it is filled; then any number of threads may read it.
class ORTUNG_API DirectionTable {
 public:
  static constexpr int kSlack = 64;  ///< readable bytes behind a row's last entry
  static constexpr int kMostDirections = 36000;

  DirectionTable() = default;

  /// @param directions directions a turn, at least 1; direction k is 2 pi k / directions
  void start(const FieldRegion& region, int directions, int longestRun);
  /// Sets the level of the direction nearest to @p angle, unless an angle nearer to that direction
  /// was learned before. Cells that are not open are ignored.
  void learn(double x, double y, double angle, std::uint8_t level);
  /// Gives directions that no angle fell on the level of a neighbour at most kWidestGap away,
  /// drops rows that still have holes, and repeats the beginnings of rows behind their ends.
  void finish();
  static constexpr int kWidestGap = 2;  ///< directions to a neighbour that finish() copies, at most

  int directions() const { return directions_; }
  double step() const;  ///< angle between directions [rad]
  const FieldGrid& grid() const { return grid_; }
  /// Returns the row of levels of the cell that holds the point, or nullptr.
  /// directions() + longestRun entries can be read, and kSlack more bytes belong to the table, so
  /// that whole vectors may be loaded.
  const std::uint8_t* row(double x, double y) const {
    const std::ptrdiff_t cell = grid_.cellAt(x, y);
    return cell < 0 ? nullptr : rowOfCell(cell);
  }
  /// The same by the cell's number. @pre the cell is in the grid
  const std::uint8_t* rowOfCell(std::ptrdiff_t cell) const {
    const std::int32_t row = rowOf_[static_cast<std::size_t>(cell)];
    return row < 0 ? nullptr : levels_.data() + static_cast<std::size_t>(row) * stride_;
  }
  /// Returns the direction nearest to @p angle [rad], in [0, directions()).
  int directionOf(double angle) const;

  /// Returns the number of each cell's row, -1 for cells without one.
  std::span<const std::int32_t> rowIndex() const { return rowOf_; }
  std::span<const std::uint8_t> levels() const { return levels_; }
  std::size_t stride() const { return stride_; }

  /// Writes the table's arrays, whose names begin with @p prefix. @throws TableError
  void save(TableWriter& file, const std::string& prefix) const;
  /// @param longestRunOf longest run by number of directions, as given to start()
  /// @throws TableError also for row numbers outside of the table
  void load(const std::shared_ptr<const TableFile>& file, const std::string& prefix,
            const FieldGrid& grid, const std::function<int(int)>& longestRunOf);

 private:
  FieldGrid grid_;
  int directions_ = 1;
  std::size_t stride_ = 1;
  std::vector<std::int32_t> ownRowOf_;
  std::vector<std::uint8_t> ownLevels_;
  /// Closeness of the angle learned, by entry, while learning; 0: none yet.
  std::vector<std::uint8_t> closeness_;
  std::span<const std::int32_t> rowOf_;
  std::span<const std::uint8_t> levels_;
  std::shared_ptr<const TableFile> file_;  ///< owner of the spans' memory; may be null
};

}  // namespace ortung

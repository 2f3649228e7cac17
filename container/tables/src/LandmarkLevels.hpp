#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "ortung/base/Export.hpp"
#include "ortung/tables/PositionTable.hpp"

namespace ortung {

/// A copy of the tables of a list of landmarks, in the order in which they are looked up: what is
/// expected of all landmarks in one cell is contiguous. So samples all over a field read a few
/// lines of memory each, not two for every table. It is twice as large as the tables. Never changed
/// once made; any number of threads may read it.
class ORTUNG_API LandmarkLevels {
 public:
  /// Lists whose copy would be larger have none.
  static constexpr std::size_t kMostBytes = std::size_t{8} << 20;

  struct Tables {
    const PositionTable& range;
    const BearingTable& bearing;
  };

  LandmarkLevels() = default;
  /// Stays empty if the copy would be too large, or if tables were never learned.
  explicit LandmarkLevels(std::span<const Tables> landmarks);

  bool isEmpty() const { return entries_.empty(); }
  /// Returns where a cell's entries begin.
  std::uint32_t placeOf(std::int32_t cell) const {
    return static_cast<std::uint32_t>(cell) * stride_;
  }
  /// Returns entries by cell, then two by landmark: its own and that of the cell at the right, so
  /// that one load takes both. The distance's level is in the lower half, the direction's in the
  /// upper one. (In the last column, the cell itself stands in for the one at the right.)
  const std::uint32_t* entries() const { return entries_.data(); }
  /// Says by cell whether it, the cells at its right and above, and the one between those know all
  /// landmarks, as far as they are in the grid.
  const std::uint8_t* isWhole() const { return isWhole_.data(); }

 private:
  void findWhole(const FieldGrid& grid);

  std::uint32_t stride_ = 0;  ///< entries of a cell
  std::vector<std::uint32_t> entries_;
  std::vector<std::uint8_t> isWhole_;
};

}  // namespace ortung

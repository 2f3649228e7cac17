#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "CellLookup.hpp"
#include "ortung/base/Export.hpp"

namespace ortung {

/// Where poses, a block of them at a time, lie between the centres of a grid's cells. Beyond the
/// outermost centres the pose counts as if it were on the line through them.
class ORTUNG_API CellCorners {
 public:
  static constexpr std::size_t kBlock = 256;

  explicit CellCorners(const FieldGrid& grid);

  /// @param n number of poses, at most kBlock
  void start(const SensorPoses& poses, std::size_t n);

  std::int32_t own(std::size_t k) const { return own_[k]; }  ///< the pose's cell; -1: outside
  /// The cell below and left of the pose; the three others are at right() and up() from there.
  std::int32_t lowest(std::size_t k) const { return lowest_[k]; }
  std::int32_t right() const { return grid_.right; }  ///< 0: the grid has one column
  std::int32_t up() const { return grid_.up; }        ///< 0: the grid has one row
  /// How far the pose is on its way to the cells at the right, or above, in [0, 1].
  float shareX(std::size_t k) const { return shareX_[k]; }
  float shareY(std::size_t k) const { return shareY_[k]; }
  const float* sharesX() const { return shareX_.data(); }
  const float* sharesY() const { return shareY_.data(); }

 private:
  struct Grid {
    explicit Grid(const FieldGrid& grid);

    CellLookup lookup;
    float originX;  ///< centre of the first cell [m]
    float originY;
    float perMetre;
    std::int32_t columns;
    std::int32_t right;
    std::int32_t up;
    float mostColumns;  ///< place of the last column
    float mostRows;
    float lastColumn;  ///< the last one that has a neighbour at its right
    float lastRow;
  };
  struct Start;

  Grid grid_;
  std::array<std::int32_t, kBlock> own_;
  std::array<std::int32_t, kBlock> lowest_;
  std::array<float, kBlock> shareX_;
  std::array<float, kBlock> shareY_;
};

}  // namespace ortung

#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "CellLookup.hpp"

namespace ortung {

/// Where poses, a block of them at a time, lie between the centres of a grid's cells. Beyond the
/// outermost centres the pose counts as if it were on the line through them.
class CellCorners {
 public:
  static constexpr std::size_t kBlock = 64;

  explicit CellCorners(const FieldGrid& grid)
      : lookup_(grid),
        originX_(static_cast<float>(grid.originX + 0.5 * grid.cell)),
        originY_(static_cast<float>(grid.originY + 0.5 * grid.cell)),
        perMetre_(static_cast<float>(1.0 / grid.cell)),
        columns_(grid.columns),
        right_(grid.columns > 1 ? 1 : 0),
        up_(grid.rows > 1 ? grid.columns : 0),
        mostColumns_(static_cast<float>(std::max(0, grid.columns - 1))),
        mostRows_(static_cast<float>(std::max(0, grid.rows - 1))),
        lastColumn_(static_cast<float>(std::max(0, grid.columns - 2))),
        lastRow_(static_cast<float>(std::max(0, grid.rows - 2))) {}

  /// @param n number of poses, at most kBlock
  void start(const SensorPoses& poses, std::size_t n) {
    for (std::size_t k = 0; k < n; ++k) own_[k] = lookup_.index(poses.x[k], poses.y[k]);
    for (std::size_t k = 0; k < n; ++k) {  // vectorizes
      const float column = bounded((poses.x[k] - originX_) * perMetre_, mostColumns_);
      const float row = bounded((poses.y[k] - originY_) * perMetre_, mostRows_);
      const auto left = static_cast<std::int32_t>(column < lastColumn_ ? column : lastColumn_);
      const auto below = static_cast<std::int32_t>(row < lastRow_ ? row : lastRow_);
      lowest_[k] = below * columns_ + left;
      shareX_[k] = column - static_cast<float>(left);
      shareY_[k] = row - static_cast<float>(below);
    }
  }

  std::int32_t own(std::size_t k) const { return own_[k]; }  ///< the pose's cell; -1: outside
  /// The cell below and left of the pose; the three others are at right() and up() from there.
  std::int32_t lowest(std::size_t k) const { return lowest_[k]; }
  std::int32_t right() const { return right_; }  ///< 0: the grid has one column
  std::int32_t up() const { return up_; }        ///< 0: the grid has one row
  /// How far the pose is on its way to the cells at the right, or above, in [0, 1].
  float shareX(std::size_t k) const { return shareX_[k]; }
  float shareY(std::size_t k) const { return shareY_[k]; }

 private:
  static float bounded(float place, float most) {
    const float least = place > 0.0F ? place : 0.0F;  // also for NaN
    return least < most ? least : most;
  }

  CellLookup lookup_;
  float originX_;  ///< centre of the first cell [m]
  float originY_;
  float perMetre_;
  std::int32_t columns_;
  std::int32_t right_;
  std::int32_t up_;
  float mostColumns_;  ///< place of the last column
  float mostRows_;
  float lastColumn_;  ///< the last one that has a neighbour at its right
  float lastRow_;
  std::array<std::int32_t, kBlock> own_;
  std::array<std::int32_t, kBlock> lowest_;
  std::array<float, kBlock> shareX_;
  std::array<float, kBlock> shareY_;
};

}  // namespace ortung

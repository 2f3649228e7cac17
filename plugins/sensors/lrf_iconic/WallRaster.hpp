#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "ortung/tables/FieldModel.hpp"

namespace ortung {

/// Where a piece of an outline can lie: for each cell of the field, and for each square of 2, 4, 8,
/// ... cells, the directions of the walls near it, one bit for each of 32. What a square lacks, no
/// cell of it has, so whole squares can be ruled out at once (Olson 2009, Hess 2016).
class WallRaster {
 public:
  static constexpr int kLevels = 7;  ///< squares of 1 to 64 cells
  static constexpr int kDirections = 32;

  /// @param reach greatest distance of a piece from its wall [m]
  /// @param angle greatest angle between a piece and its wall [rad]
  WallRaster(std::span<const FieldWall> walls, double reach, double angle);

  double cell() const { return cell_; }  ///< length of a cell's side [m]
  int columns() const { return columns_; }
  int rows() const { return rows_; }
  double originX() const { return originX_; }  ///< left edge of column 0 in the field frame [m]
  double originY() const { return originY_; }

  /// Returns the directions of the walls near any cell of the square of 2^level cells whose corner
  /// this cell is; columns and rows may be outside, where nothing is.
  std::uint32_t directions(int level, int column, int row) const {
    const auto x = static_cast<unsigned>(column + kMargin);
    const auto y = static_cast<unsigned>(row + kMargin);
    if (x >= static_cast<unsigned>(width_) || y >= static_cast<unsigned>(height_)) return 0;
    return levels_[static_cast<std::size_t>(level)][static_cast<std::size_t>(y) * width_ + x];
  }
  /// Returns the bit of a direction in the field frame [rad].
  static std::uint32_t bitOf(double direction);

 private:
  /// Cells before column and row 0, of which squares reach into the field.
  static constexpr int kMargin = 1 << (kLevels - 1);
  void draw(const FieldWall& wall, double reach, double angle);
  void addLevels();

  double cell_ = 0.1;
  double originX_ = 0.0;
  double originY_ = 0.0;
  int columns_ = 0;
  int rows_ = 0;
  int width_ = 0;  ///< columns with the margin
  int height_ = 0;
  std::vector<std::vector<std::uint32_t>> levels_;
};

}  // namespace ortung

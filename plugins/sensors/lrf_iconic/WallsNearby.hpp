#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "ortung/tables/FieldModel.hpp"

namespace ortung {

/// Which walls are near a point: squares of the field with the walls that come near them.
class WallsNearby {
 public:
  /// @param reach distance up to which a wall counts as near [m]
  WallsNearby(std::span<const FieldWall> walls, double reach);

  /// Returns the indices of all walls within reach of a point, and of some beyond, in ascending
  /// order.
  /// @param x, y in the field frame [m]
  std::span<const std::uint32_t> at(double x, double y) const;

 private:
  double side_ = 1.0;  ///< of a square [m]
  double originX_ = 0.0;
  double originY_ = 0.0;
  int columns_ = 0;
  int rows_ = 0;
  std::vector<std::uint32_t> first_;  ///< index in walls_ of each square's first, and of the end
  std::vector<std::uint32_t> walls_;
};

}  // namespace ortung

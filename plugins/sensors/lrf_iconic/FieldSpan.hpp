#pragma once

#include <algorithm>
#include <cmath>
#include <span>

#include "ortung/tables/FieldModel.hpp"

namespace ortung {

/// The rectangle along the field's axes that holds some walls.
struct FieldSpan {
  double left = 0.0;  ///< in the field frame [m]
  double low = 0.0;
  double right = 0.0;
  double high = 0.0;

  /// @param around distance that is added on all sides [m]
  FieldSpan(std::span<const FieldWall> walls, double around) {
    if (!walls.empty()) {
      left = right = walls.front().x0;
      low = high = walls.front().y0;
    }
    for (const FieldWall& wall : walls) {
      left = std::min({left, wall.x0, wall.x1});
      right = std::max({right, wall.x0, wall.x1});
      low = std::min({low, wall.y0, wall.y1});
      high = std::max({high, wall.y0, wall.y1});
    }
    left -= around;
    low -= around;
    right += around;
    high += around;
  }

  /// Returns the least length of a cell's side, from @p finest [m] upwards, with which there are
  /// no more than so many cells, @p margin columns and rows of them around the span.
  double cellFor(double finest, double most, int margin) const {
    double cell = finest;
    while ((std::ceil((right - left) / cell) + margin) * (std::ceil((high - low) / cell) + margin) >
           most)
      cell *= 1.25;
    return cell;
  }
};

}  // namespace ortung

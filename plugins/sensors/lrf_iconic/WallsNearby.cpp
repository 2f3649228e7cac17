#include "WallsNearby.hpp"

#include <numbers>

#include "FieldSpan.hpp"

namespace ortung {
namespace {

constexpr double kMostSquares = 1e5;  // larger fields have larger squares

/// Returns the distance of a point from a wall [m].
double distanceFrom(const FieldWall& wall, double x, double y) {
  const double dx = wall.x1 - wall.x0;
  const double dy = wall.y1 - wall.y0;
  const double along = ((x - wall.x0) * dx + (y - wall.y0) * dy) / (dx * dx + dy * dy);
  const double t = std::clamp(along, 0.0, 1.0);
  return std::hypot(x - wall.x0 - t * dx, y - wall.y0 - t * dy);
}

}  // namespace

WallsNearby::WallsNearby(std::span<const FieldWall> walls, double reach) {
  const FieldSpan span(walls, reach);
  side_ = span.cellFor(1.0, kMostSquares, 0);
  originX_ = span.left;
  originY_ = span.low;
  columns_ = static_cast<int>(std::ceil((span.right - span.left) / side_));
  rows_ = static_cast<int>(std::ceil((span.high - span.low) / side_));
  std::vector<std::vector<std::uint32_t>> squares(static_cast<std::size_t>(columns_) *
                                                  static_cast<std::size_t>(rows_));
  const double far = reach + side_ / std::numbers::sqrt2;  // from a square's middle
  for (std::uint32_t i = 0; i < walls.size(); ++i) {
    const FieldWall& wall = walls[i];
    const FieldSpan around(walls.subspan(i, 1), reach);
    const int right = std::min(static_cast<int>((around.right - originX_) / side_), columns_ - 1);
    const int top = std::min(static_cast<int>((around.high - originY_) / side_), rows_ - 1);
    for (int row = std::max(static_cast<int>((around.low - originY_) / side_), 0); row <= top;
         ++row)
      for (int column = std::max(static_cast<int>((around.left - originX_) / side_), 0);
           column <= right; ++column)
        if (distanceFrom(wall, originX_ + (column + 0.5) * side_, originY_ + (row + 0.5) * side_) <=
            far)
          squares[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
                  static_cast<std::size_t>(column)]
              .push_back(i);
  }
  for (const auto& square : squares) {
    first_.push_back(static_cast<std::uint32_t>(walls_.size()));
    walls_.insert(walls_.end(), square.begin(), square.end());
  }
  first_.push_back(static_cast<std::uint32_t>(walls_.size()));
}

std::span<const std::uint32_t> WallsNearby::at(double x, double y) const {
  const double column = std::floor((x - originX_) / side_);
  const double row = std::floor((y - originY_) / side_);
  if (!(column >= 0.0 && column < columns_ && row >= 0.0 && row < rows_)) return {};
  const auto square = static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
                      static_cast<std::size_t>(column);
  return std::span(walls_).subspan(first_[square], first_[square + 1] - first_[square]);
}

}  // namespace ortung

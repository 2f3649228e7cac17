#include "WallRaster.hpp"

#include <algorithm>
#include <cmath>

#include "FieldSpan.hpp"
#include "ortung/base/Angles.hpp"

namespace ortung {
namespace {

constexpr double kMostCells = 2e6;  // of a field; larger ones have larger cells
constexpr double kFinest = 0.1;     // least length of a cell's side [m]

/// The x of a row that meet some conditions.
struct Range {
  double from;
  double to;

  /// Keeps those with low <= factor x <= high.
  void narrow(double factor, double low, double high) {
    constexpr double kParallel = 1e-9;
    if (std::abs(factor) < kParallel) {
      if (low > 0.0 || high < 0.0) to = from - 1.0;
      return;
    }
    from = std::max(from, (factor > 0.0 ? low : high) / factor);
    to = std::min(to, (factor > 0.0 ? high : low) / factor);
  }
};

int binOf(double direction) {
  const double bins = direction / kTurn * WallRaster::kDirections;
  const int bin = static_cast<int>(std::floor(bins)) % WallRaster::kDirections;
  return bin < 0 ? bin + WallRaster::kDirections : bin;
}

}  // namespace

std::uint32_t WallRaster::bitOf(double direction) { return 1U << binOf(direction); }

WallRaster::WallRaster(std::span<const FieldWall> walls, double reach, double angle) {
  const FieldSpan span(walls, reach);
  cell_ = span.cellFor(kFinest, kMostCells, kMargin);
  originX_ = span.left;
  originY_ = span.low;
  columns_ = static_cast<int>(std::ceil((span.right - span.left) / cell_));
  rows_ = static_cast<int>(std::ceil((span.high - span.low) / cell_));
  width_ = columns_ + kMargin;
  height_ = rows_ + kMargin;
  levels_.resize(kLevels);
  levels_[0].assign(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_), 0);
  for (const FieldWall& wall : walls) draw(wall, reach, angle);
  addLevels();
}

/// Marks the cells whose middles are within reach of the wall and half a cell more.
void WallRaster::draw(const FieldWall& wall, double reach, double angle) {
  const double length = lengthOf(wall);
  const double cosine = (wall.x1 - wall.x0) / length;
  const double sine = (wall.y1 - wall.y0) / length;
  const double direction = std::atan2(sine, cosine);
  std::uint32_t bits = bitOf(direction + angle);
  constexpr double kBin = kTurn / kDirections;
  for (double d = -angle; d < angle; d += 0.5 * kBin) bits |= bitOf(direction + d);
  const double wide = reach + 0.5 * cell_;
  const FieldSpan around({&wall, 1}, wide);
  const int low = std::max(static_cast<int>((around.low - originY_) / cell_), 0);
  const int high = std::min(static_cast<int>((around.high - originY_) / cell_), rows_ - 1);
  for (int row = low; row <= high; ++row) {
    const double y = originY_ + (row + 0.5) * cell_ - wall.y0;
    Range range{around.left - wall.x0, around.right - wall.x0};
    range.narrow(sine, cosine * y - wide, cosine * y + wide);
    range.narrow(cosine, -wide - sine * y, length + wide - sine * y);
    const double shift = wall.x0 - originX_;
    const double first = std::max(std::ceil((range.from + shift) / cell_ - 0.5), 0.0);
    const double last = std::min(std::floor((range.to + shift) / cell_ - 0.5), columns_ - 1.0);
    for (double column = first; column <= last; column += 1.0)
      levels_[0][static_cast<std::size_t>(row + kMargin) * static_cast<std::size_t>(width_) +
                 static_cast<std::size_t>(column) + kMargin] |= bits;
  }
}

/// Makes each level of the one below it: a square is four of half its side.
void WallRaster::addLevels() {
  const auto width = static_cast<std::size_t>(width_);
  const auto height = static_cast<std::size_t>(height_);
  for (std::size_t level = 1; level < levels_.size(); ++level) {
    const std::vector<std::uint32_t>& below = levels_[level - 1];
    std::vector<std::uint32_t>& out = levels_[level];
    out = below;
    const std::size_t half = std::size_t{1} << (level - 1);
    for (std::size_t y = 0; y < height; ++y)
      for (std::size_t x = 0; x < width; ++x) {
        std::uint32_t bits = below[y * width + x];
        if (x + half < width) bits |= below[y * width + x + half];
        if (y + half < height) bits |= below[(y + half) * width + x];
        if (x + half < width && y + half < height) bits |= below[(y + half) * width + x + half];
        out[y * width + x] = bits;
      }
  }
}

}  // namespace ortung

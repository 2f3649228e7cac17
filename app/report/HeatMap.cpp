#include "HeatMap.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace ortung::app {
namespace {

constexpr int kWantedWidth = 800;  // [pixels]
constexpr int kMostHeight = 4000;  // [pixels], for zooming only
constexpr int kMostZoom = 40;
constexpr int kMargin = 12;
constexpr int kBarHeight = 16;
constexpr int kTicks = 5;
constexpr int kLetters = 2;  // size of a font pixel
constexpr int kLineHeight = 12 * kLetters;
constexpr double kLeastShare = 1e-6;  // of a scale's top: where logarithmic ones end
constexpr Colour kPaper{255, 255, 255};
constexpr Colour kBlack{0, 0, 0};
constexpr Colour kSolid{214, 219, 226};
constexpr Colour kNoValue{228, 238, 250};
constexpr Colour kTruth{214, 40, 40};

int zoomOf(const FieldGrid& grid) {
  const int byWidth = (kWantedWidth + grid.columns - 1) / grid.columns;
  return std::clamp(std::min(byWidth, kMostHeight / grid.rows), 1, kMostZoom);
}

/// Place of a value between white (0) and black (1).
double darkness(const HeatMap& map, const HeatMap::Scale& scale, double value) {
  if (!(scale.high > scale.low)) return 0.5;
  if (!map.logarithmic) return (value - scale.low) / (scale.high - scale.low);
  return std::log(std::max(value, scale.low) / scale.low) / std::log(scale.high / scale.low);
}

Colour grey(double dark) {
  // The palest grey stays apart from the paper, the darkest from the outlines.
  const auto level =
      static_cast<std::uint8_t>(std::lround(250.0 - 225.0 * std::clamp(dark, 0.0, 1.0)));
  return {level, level, level};
}

/// Draws cells with the grid's upper left corner at a place of the picture.
class CellPainter {
 public:
  CellPainter(Picture& picture, const HeatMap& map, int top)
      : picture_(picture), map_(map), grid_(map.region->grid), zoom_(zoomOf(grid_)), top_(top) {}

  void paint() {
    const HeatMap::Scale scale = map_.scale();
    picture_.fill(kMargin - 1, top_ - 1, grid_.columns * zoom_ + 2, grid_.rows * zoom_ + 2, kBlack);
    for (int row = 0; row < grid_.rows; ++row) {
      for (int column = 0; column < grid_.columns; ++column) {
        picture_.fill(left(column), above(row), zoom_, zoom_, colourOf(column, row, scale));
        if (!isOpen(column, row)) outline(column, row);
      }
    }
  }

  void mark(const Pose2& pose) {
    const double x = kMargin + zoom_ * (pose.x - grid_.originX) / grid_.cell;
    const double y = top_ + zoom_ * (grid_.rows - (pose.y - grid_.originY) / grid_.cell);
    constexpr double kRadius = 9.0;
    picture_.ring(x, y, kRadius, 3, kTruth);
    picture_.line(x, y, x + 2.0 * kRadius * std::cos(pose.theta),
                  y - 2.0 * kRadius * std::sin(pose.theta), 3, kTruth);
  }

 private:
  bool isOpen(int column, int row) const {
    if (column < 0 || row < 0 || column >= grid_.columns || row >= grid_.rows) return false;
    return map_.region->open[index(column, row)] != 0;
  }
  std::size_t index(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(grid_.columns) +
           static_cast<std::size_t>(column);
  }
  int left(int column) const { return kMargin + column * zoom_; }
  int above(int row) const { return top_ + (grid_.rows - 1 - row) * zoom_; }

  Colour colourOf(int column, int row, const HeatMap::Scale& scale) const {
    if (!isOpen(column, row)) return kSolid;
    const double value = map_.values[index(column, row)];
    return std::isfinite(value) ? grey(darkness(map_, scale, value)) : kNoValue;
  }

  /// Black lines within a solid cell, towards its open neighbours.
  void outline(int column, int row) {
    const int thick = std::max(1, zoom_ / 4);
    const int x = left(column);
    const int y = above(row);
    if (isOpen(column - 1, row)) picture_.fill(x, y, thick, zoom_, kBlack);
    if (isOpen(column + 1, row)) picture_.fill(x + zoom_ - thick, y, thick, zoom_, kBlack);
    if (isOpen(column, row + 1)) picture_.fill(x, y, zoom_, thick, kBlack);
    if (isOpen(column, row - 1)) picture_.fill(x, y + zoom_ - thick, zoom_, thick, kBlack);
  }

  Picture& picture_;
  const HeatMap& map_;
  const FieldGrid& grid_;
  int zoom_;
  int top_;
};

void drawLegend(Picture& picture, const HeatMap& map, int top) {
  const int width = picture.width() - 2 * kMargin;
  for (int x = 0; x < width; ++x) {
    picture.fill(kMargin + x, top, 1, kBarHeight, grey(static_cast<double>(x) / width));
  }
  const std::vector<double> values = map.legend(kTicks);
  for (int tick = 0; tick < kTicks; ++tick) {
    const std::string text =
        fmt::format("{:.3g}{}{}", values[static_cast<std::size_t>(tick)],
                    map.unit.empty() ? "" : " ", tick == kTicks - 1 ? map.unit : "");
    const int centre = kMargin + tick * width / (kTicks - 1);
    const int room = picture.width() - kMargin - Picture::textWidth(kLetters, text);
    const int x = centre - Picture::textWidth(kLetters, text) / 2;
    picture.fill(std::min(centre, kMargin + width - 1), top + kBarHeight, 1, 4, kBlack);
    picture.text(std::clamp(x, kMargin, std::max(room, kMargin)), top + kBarHeight + 7, kLetters,
                 kBlack, text);
  }
}

}  // namespace

HeatMap::Scale HeatMap::scale() const {
  Scale ends;
  bool any = false;
  for (std::size_t cell = 0; cell < values.size(); ++cell) {
    const double value = values[cell];
    if (!std::isfinite(value) || region->open[cell] == 0) continue;
    ends.low = any ? std::min(ends.low, value) : value;
    ends.high = any ? std::max(ends.high, value) : value;
    any = true;
  }
  if (logarithmic) {
    ends.low = std::max(ends.low, ends.high * kLeastShare);
  } else if (ends.low > 0.0 && ends.low < ends.high * kLeastShare) {
    ends.low = 0.0;  // a legend that begins at 1e-157 helps nobody
  }
  return ends;
}

std::vector<double> HeatMap::legend(int count) const {
  const Scale ends = scale();
  std::vector<double> at;
  for (int i = 0; i < count; ++i) {
    const double share = static_cast<double>(i) / (count - 1);
    const bool byLogarithm = logarithmic && ends.low > 0.0;
    at.push_back(byLogarithm ? ends.low * std::pow(ends.high / ends.low, share)
                             : ends.low + share * (ends.high - ends.low));
  }
  return at;
}

Picture draw(const HeatMap& map) {
  const FieldGrid& grid = map.region->grid;
  const int zoom = zoomOf(grid);
  const int top = kMargin + kLineHeight;
  const int legendTop = top + grid.rows * zoom + kMargin;
  const int width = std::max(grid.columns * zoom, kWantedWidth / 2) + 2 * kMargin;
  Picture picture(width, legendTop + kBarHeight + 2 * kLineHeight, kPaper);
  const bool fits = Picture::textWidth(kLetters, map.caption) <= width - 2 * kMargin;
  picture.text(kMargin, kMargin, fits ? kLetters : 1, kBlack, map.caption);
  CellPainter painter(picture, map, top);
  painter.paint();
  if (map.truth && isFinite(*map.truth)) painter.mark(*map.truth);
  drawLegend(picture, map, legendTop);
  return picture;
}

}  // namespace ortung::app

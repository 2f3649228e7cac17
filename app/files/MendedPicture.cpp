#include "MendedPicture.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "Palette.hpp"

namespace ortung::app {
namespace {

constexpr int kWanted = 900;     // width and height of one map [px]
constexpr double kAround = 2.0;  // of what has changed [m]
constexpr double kLeast = 6.0;   // width and height of what is drawn [m]
constexpr int kBetween = 16;     // [px]
constexpr int kAbove = 32;       // [px]
constexpr int kLetters = 2;      // size of a font pixel
constexpr int kMostZoom = 12;    // [px]

/// The cells that are drawn.
struct Part {
  long column;
  long row;
  long columns;
  long rows;
  int zoom;
};

/// An extent in one axis [m].
struct Extent {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();
  void add(double at) {
    low = std::min(low, at);
    high = std::max(high, at);
  }
  void widen() {
    const double more = std::max(kAround, 0.5 * (kLeast - (high - low)));
    low -= more;
    high += more;
  }
};

Part partOf(const WorldGrid& grid, const ChangesData::Reading& changes) {
  Extent x;
  Extent y;
  for (const ChangesData::Cell& one : changes.cells) {
    if (!one.isSure) continue;
    x.add(one.x);
    y.add(one.y);
  }
  x.widen();
  y.widen();
  const auto cellOf = [&](double at, double origin, std::size_t count) {
    const double cell = std::floor((at - origin) / grid.cell);
    return std::lround(std::clamp(cell, 0.0, static_cast<double>(count) - 1.0));
  };
  Part part{cellOf(x.low, grid.originX, grid.columns), cellOf(y.low, grid.originY, grid.rows), 0, 0,
            1};
  part.columns = cellOf(x.high, grid.originX, grid.columns) - part.column + 1;
  part.rows = cellOf(y.high, grid.originY, grid.rows) - part.row + 1;
  part.zoom =
      static_cast<int>(std::clamp<long>(kWanted / std::max(part.columns, part.rows), 1, kMostZoom));
  return part;
}

Colour colourOf(char cell) {
  if (cell == WorldGrid::kOccupied) return palette::kInk;
  return cell == WorldGrid::kFree ? palette::kPaper : palette::kNoValue;
}

void drawMap(const WorldGrid& grid, const Part& part, int left, Picture& picture) {
  for (long row = 0; row < part.rows; ++row)
    for (long column = 0; column < part.columns; ++column) {
      const auto at = static_cast<std::size_t>(part.row + row) * grid.columns +
                      static_cast<std::size_t>(part.column + column);
      picture.fill(left + static_cast<int>(column) * part.zoom,
                   kAbove + static_cast<int>(part.rows - 1 - row) * part.zoom, part.zoom, part.zoom,
                   colourOf(grid.cells[at]));
    }
}

void drawChanges(const WorldGrid& grid, const ChangesData::Reading& changes, const Part& part,
                 int left, Picture& picture) {
  const int half = std::max(1, static_cast<int>(0.5 * changes.cell / grid.cell * part.zoom));
  for (const ChangesData::Cell& one : changes.cells) {
    if (!one.isSure) continue;
    const double column = (one.x - grid.originX) / grid.cell - static_cast<double>(part.column);
    const double row = (one.y - grid.originY) / grid.cell - static_cast<double>(part.row);
    if (!(column >= 0.0 && row >= 0.0 && column < static_cast<double>(part.columns) &&
          row < static_cast<double>(part.rows)))
      continue;
    const int x = left + static_cast<int>(column * part.zoom);
    const int y = kAbove + static_cast<int>((static_cast<double>(part.rows) - row) * part.zoom);
    picture.fill(x - half, y - half, 2 * half, 2 * half,
                 one.isNew ? palette::kLandmark : palette::kTruth);
  }
}

}  // namespace

Picture drawMended(const WorldGrid& before, const ChangesData::Reading& changes,
                   const WorldGrid& after) {
  const Part part = partOf(before, changes);
  const int width = static_cast<int>(part.columns) * part.zoom;
  const int height = static_cast<int>(part.rows) * part.zoom;
  Picture picture(3 * width + 2 * kBetween, kAbove + height, {240, 240, 240});
  const auto left = [&](int number) { return number * (width + kBetween); };
  drawMap(before, part, left(0), picture);
  drawMap(before, part, left(1), picture);
  drawChanges(before, changes, part, left(1), picture);
  drawMap(after, part, left(2), picture);
  picture.text(left(0) + 4, 8, kLetters, palette::kInk, "as it is");
  picture.text(left(1) + 4, 8, kLetters, palette::kTruth, "gone");
  picture.text(left(1) + 4 + Picture::textWidth(kLetters, "gone  "), 8, kLetters,
               palette::kLandmark, "new");
  picture.text(left(2) + 4, 8, kLetters, palette::kInk, "proposed");
  return picture;
}

}  // namespace ortung::app

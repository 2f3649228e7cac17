#include "FreeSpace.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace ortung {
namespace {

constexpr double kMaxCells = 67108864.0;  // 2^26
constexpr double kHair = 1e-9;            ///< what rounding may do to a coordinate [m]

/// The cells of a row or column of @p n that [low, high] meets, half open.
struct Cells {
  int from, to;
};
Cells cellsWithin(double low, double high, double origin, double cell, int n) {
  const double last = static_cast<double>(n);
  const double from = std::clamp(std::floor((low - origin) / cell), 0.0, last);
  const double to = std::clamp(std::floor((high - origin) / cell) + 1.0, 0.0, last);
  return {static_cast<int>(from), static_cast<int>(to)};
}

FieldGrid gridOver(const Box2& bounds, double cell) {
  if (!(cell >= 0.001 && cell <= 1000.0))
    throw std::invalid_argument("the edge of a cell is " + std::to_string(cell) +
                                " m, expected 0.001 to 1000");
  const double columns = std::ceil((bounds.xHigh - bounds.xLow) / cell - 1e-6);
  const double rows = std::ceil((bounds.yHigh - bounds.yLow) / cell - 1e-6);
  if (!(columns * rows <= kMaxCells))
    throw std::invalid_argument("cells of " + std::to_string(cell) + " m make " +
                                std::to_string(static_cast<long long>(columns * rows)) +
                                " of them, expected at most 2^26; use larger cells");
  return {bounds.xLow, bounds.yLow, cell, std::max(1, static_cast<int>(columns)),
          std::max(1, static_cast<int>(rows))};
}

}  // namespace

FreeSpace::FreeSpace(const WorldModel& world) : bounds_(world.bounds) {
  for (const Primitive& primitive : world.primitives)
    if (primitive.isSolid() && primitive.zLow <= kTallestRobot) bodies_.push_back(&primitive);
  for (const GridBody& body : world.grids)
    if (body.zLow <= kTallestRobot) grids_.push_back({&body.map, distanceToOccupied(body.map)});
}

bool FreeSpace::isInField(double x, double y, double radius) const {
  return x - radius >= bounds_.xLow - kHair && x + radius <= bounds_.xHigh + kHair &&
         y - radius >= bounds_.yLow - kHair && y + radius <= bounds_.yHigh + kHair;
}

bool FreeSpace::isKnown(const Grid& grid, double x, double y) {
  const GridMap& map = *grid.map;
  const double column = std::floor((x - map.originX) / map.cell);
  const double row = std::floor((y - map.originY) / map.cell);
  if (!(column >= 0 && row >= 0 && column < map.columns && row < map.rows)) return false;
  const GridCell cell = map.at(static_cast<int>(column), static_cast<int>(row));
  return cell == GridCell::free || cell == GridCell::unknownNearFree;
}

bool FreeSpace::touches(const Grid& grid, double x, double y, double radius) {
  const GridMap& map = *grid.map;
  const double column = std::floor((x - map.originX) / map.cell);
  const double row = std::floor((y - map.originY) / map.cell);
  if (column >= 0 && row >= 0 && column < map.columns && row < map.rows) {
    const double between =
        map.cell * static_cast<double>(
                       grid.toOccupied[map.index(static_cast<int>(column), static_cast<int>(row))]);
    // From centre to centre; point and surface are each within half a diagonal of theirs.
    if (between - map.cell * std::sqrt(2.0) > radius + kHair) return false;
    if (between + map.cell * std::sqrt(0.5) < radius) return true;
  }
  const Cells columns = cellsWithin(x - radius, x + radius, map.originX, map.cell, map.columns);
  const Cells rows = cellsWithin(y - radius, y + radius, map.originY, map.cell, map.rows);
  for (int r = rows.from; r < rows.to; ++r) {
    const double low = map.originY + r * map.cell;
    const double dy = std::max({0.0, low - y, y - low - map.cell});
    for (int c = columns.from; c < columns.to; ++c) {
      if (map.at(c, r) != GridCell::occupied) continue;
      const double left = map.originX + c * map.cell;
      const double dx = std::max({0.0, left - x, x - left - map.cell});
      if (dx * dx + dy * dy <= radius * radius) return true;
    }
  }
  return false;
}

bool FreeSpace::isFreeOfGrids(double x, double y, double radius) const {
  bool known = grids_.empty();
  for (const Grid& grid : grids_) {
    if (touches(grid, x, y, radius)) return false;
    known = known || isKnown(grid, x, y);
  }
  return known;
}

bool FreeSpace::isFree(double x, double y, double radius) const {
  if (!(std::isfinite(x) && std::isfinite(y) && radius >= 0.0)) return false;
  if (!isInField(x, y, radius) || !isFreeOfGrids(x, y, radius)) return false;
  return std::none_of(bodies_.begin(), bodies_.end(), [&](const Primitive* body) {
    return distanceTo(*body, {x, y}) <= radius;
  });
}

/// Clears the cells whose centre is within @p radius of a primitive.
void FreeSpace::block(const FieldGrid& grid, double radius, std::vector<std::uint8_t>& mask) const {
  for (const Primitive* body : bodies_) {
    const Box2 box = boundsOf(*body);
    const Cells columns =
        cellsWithin(box.xLow - radius, box.xHigh + radius, grid.originX, grid.cell, grid.columns);
    const Cells rows =
        cellsWithin(box.yLow - radius, box.yHigh + radius, grid.originY, grid.cell, grid.rows);
    for (int row = rows.from; row < rows.to; ++row) {
      for (int column = columns.from; column < columns.to; ++column) {
        const std::size_t i =
            static_cast<std::size_t>(row) * static_cast<std::size_t>(grid.columns) +
            static_cast<std::size_t>(column);
        if (mask[i] != 0 && distanceTo(*body, {grid.centreX(i), grid.centreY(i)}) <= radius)
          mask[i] = 0;
      }
    }
  }
}

FieldRegion FreeSpace::region(double cell, double robotRadius) const {
  if (!(robotRadius >= 0.0 && robotRadius <= 100.0))
    throw std::invalid_argument("the robot's radius is " + std::to_string(robotRadius) +
                                " m, expected 0 to 100");
  FieldRegion region;
  region.grid = gridOver(bounds_, cell);
  region.open.resize(region.grid.size());
  region.standable.resize(region.grid.size());
  for (std::size_t i = 0; i < region.grid.size(); ++i) {
    const double x = region.grid.centreX(i);
    const double y = region.grid.centreY(i);
    region.open[i] = isInField(x, y, 0.0) && isFreeOfGrids(x, y, 0.0) ? 1 : 0;
    region.standable[i] =
        region.open[i] != 0 && isInField(x, y, robotRadius) && isFreeOfGrids(x, y, robotRadius) ? 1
                                                                                                : 0;
  }
  block(region.grid, 0.0, region.open);
  block(region.grid, robotRadius, region.standable);
  return region;
}

}  // namespace ortung

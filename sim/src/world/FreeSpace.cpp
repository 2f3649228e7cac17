#include "FreeSpace.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace ortung {
namespace {

constexpr double kMaxCells = 67108864.0;  // 2^26
constexpr double kHair = 1e-9;            ///< rounding error of a coordinate [m]

/// The half-open range of cells in a row or column of @p n that [low, high] meets.
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

/// Returns whether a disc neither touches a box nor has its centre in it.
bool isFarFrom(const Box2& box, double x, double y, double radius) {
  constexpr double kMore = 1e-6;  // than rounding errors of the box [m]
  const double reach = radius + kMore;
  return x < box.xLow - reach || x > box.xHigh + reach || y < box.yLow - reach ||
         y > box.yHigh + reach;
}

/// Returns whether a body is in the way of something of this height on the floor.
template <class Body>
bool isMetBy(const Body& body, double height) {
  return body.zLow < height && body.zHigh > 0.0;
}

}  // namespace

FreeSpace::FreeSpace(const WorldModel& world)
    : whole_(world.bounds),
      bounds_(world.floorBounds.empty() ? std::vector{world.bounds} : world.floorBounds) {
  for (const Primitive& primitive : world.primitives)
    if (primitive.isSolid()) bodies_.push_back(&primitive);
  for (const GridBody& body : world.grids)
    grids_.push_back({&body, body.map.bounds(), distanceToOccupied(body.map)});
}

bool FreeSpace::isInField(double x, double y, double radius) const {
  return std::any_of(bounds_.begin(), bounds_.end(), [&](const Box2& box) {
    return x - radius >= box.xLow - kHair && x + radius <= box.xHigh + kHair &&
           y - radius >= box.yLow - kHair && y + radius <= box.yHigh + kHair;
  });
}

bool FreeSpace::isKnown(const Grid& grid, double x, double y) {
  const GridMap& map = grid.body->map;
  const double column = std::floor((x - map.originX) / map.cell);
  const double row = std::floor((y - map.originY) / map.cell);
  if (!(column >= 0 && row >= 0 && column < map.columns && row < map.rows)) return false;
  const GridCell cell = map.at(static_cast<int>(column), static_cast<int>(row));
  return cell == GridCell::kFree || cell == GridCell::kUnknownNearFree;
}

bool FreeSpace::touches(const Grid& grid, double x, double y, double radius) {
  const GridMap& map = grid.body->map;
  const double column = std::floor((x - map.originX) / map.cell);
  const double row = std::floor((y - map.originY) / map.cell);
  if (column >= 0 && row >= 0 && column < map.columns && row < map.rows) {
    const double between =
        map.cell * static_cast<double>(
                       grid.toOccupied[map.index(static_cast<int>(column), static_cast<int>(row))]);
    // The distance is from centre to centre; point and surface are each within half a diagonal of
    // theirs.
    if (between - map.cell * std::sqrt(2.0) > radius + kHair) return false;
    if (between + map.cell * std::sqrt(0.5) < radius) return true;
  }
  const Cells columns = cellsWithin(x - radius, x + radius, map.originX, map.cell, map.columns);
  const Cells rows = cellsWithin(y - radius, y + radius, map.originY, map.cell, map.rows);
  for (int r = rows.from; r < rows.to; ++r) {
    const double low = map.originY + r * map.cell;
    const double dy = std::max({0.0, low - y, y - low - map.cell});
    for (int c = columns.from; c < columns.to; ++c) {
      if (map.at(c, r) != GridCell::kOccupied) continue;
      const double left = map.originX + c * map.cell;
      const double dx = std::max({0.0, left - x, x - left - map.cell});
      if (dx * dx + dy * dy <= radius * radius) return true;
    }
  }
  return false;
}

bool FreeSpace::isFreeOfGrids(double x, double y, const RobotSize& size) const {
  bool isAny = false;
  bool known = false;
  for (const Grid& grid : grids_) {
    if (!isMetBy(*grid.body, size.height)) continue;
    isAny = true;
    if (isFarFrom(grid.bounds, x, y, size.radius)) continue;  // as most floors of a building are
    const Point2 at = grid.body->map.toGrid({x, y});
    if (touches(grid, at.x, at.y, size.radius)) return false;
    known = known || isKnown(grid, at.x, at.y);
  }
  return known || !isAny;
}

bool FreeSpace::isFree(double x, double y, const RobotSize& size) const {
  if (!(std::isfinite(x) && std::isfinite(y) && size.radius >= 0.0 && size.height >= 0.0))
    return false;
  if (!isInField(x, y, size.radius) || !isFreeOfGrids(x, y, size)) return false;
  return std::none_of(bodies_.begin(), bodies_.end(), [&](const Primitive* body) {
    return isMetBy(*body, size.height) && distanceTo(*body, {x, y}) <= size.radius;
  });
}

/// Clears the cells at whose centre a body is in the robot's way.
void FreeSpace::block(const FieldGrid& grid, const RobotSize& size,
                      std::vector<std::uint8_t>& mask) const {
  const double radius = size.radius;
  for (const Primitive* body : bodies_) {
    if (!isMetBy(*body, size.height)) continue;
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
        if (distanceTo(*body, {grid.centreX(i), grid.centreY(i)}) <= radius) mask[i] = 0;
      }
    }
  }
}

FieldRegion FreeSpace::region(double cell, const RobotSize& robot) const {
  for (const auto& [name, value] : {std::pair("radius", robot.radius), {"height", robot.height}})
    if (!(value >= 0.0 && value <= 100.0))
      throw std::invalid_argument(std::string("the robot's ") + name + " is " +
                                  std::to_string(value) + " m, expected 0 to 100");
  FieldRegion region;
  region.grid = gridOver(whole_, cell);
  region.open.resize(region.grid.size());
  region.standable.resize(region.grid.size());
  const RobotSize point{0.0, robot.height};
  for (std::size_t i = 0; i < region.grid.size(); ++i) {
    const double x = region.grid.centreX(i);
    const double y = region.grid.centreY(i);
    const auto hasRoom = [&](const RobotSize& size) {
      return isInField(x, y, size.radius) && isFreeOfGrids(x, y, size);
    };
    region.open[i] = hasRoom(point) ? 1 : 0;
    region.standable[i] = region.open[i] != 0 && hasRoom(robot) ? 1 : 0;
  }
  block(region.grid, point, region.open);
  block(region.grid, robot, region.standable);
  return region;
}

}  // namespace ortung

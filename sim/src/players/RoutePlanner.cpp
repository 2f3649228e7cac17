#include "ortung/sim/RoutePlanner.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <queue>
#include <stdexcept>
#include <utility>

#include "FloorParts.hpp"

namespace ortung {
namespace {

constexpr double kCell = 0.1;  // [m]
constexpr std::size_t kMaxCells =
    1u << 20;  // greatest number of cells of a plan; larger worlds get larger cells

/// Returns the edge length of a plan's cells, which grows with the world [m].
double cellFor(const SimWorld& world) {
  const Box2 b = world.solids().bounds;
  return std::max(kCell, std::sqrt((b.xHigh - b.xLow + kCell) * (b.yHigh - b.yLow + kCell) /
                                   static_cast<double>(kMaxCells)));
}

/// Returns the cells with room for a robot, coarse enough to plan on. Between the middles of two
/// neighbours there is no wall, however thin: it would be within 0.71 of a cell of one of them.
FieldRegion coarseRegion(const SimWorld& world, RobotSize robot) {
  double cell = cellFor(world);
  for (;;) {
    if (cell > kCell) robot.radius = std::max(robot.radius, 0.75 * cell);
    FieldRegion region = world.region(cell, robot);
    if (region.grid.size() <= 2 * kMaxCells) return region;
    cell *= std::sqrt(static_cast<double>(region.grid.size()) / static_cast<double>(kMaxCells));
  }
}

bool hasRoom(const FieldRegion& region) {
  return std::find(region.standable.begin(), region.standable.end(), 1) != region.standable.end();
}

/// A cell by column and row.
struct Place {
  std::ptrdiff_t column;
  std::ptrdiff_t row;
};

Place placeOf(const FieldGrid& grid, std::size_t cell) {
  const auto columns = static_cast<std::size_t>(grid.columns);
  return {static_cast<std::ptrdiff_t>(cell % columns), static_cast<std::ptrdiff_t>(cell / columns)};
}

struct Neighbour {
  int column;
  int row;
  float way;  ///< [cells]
};
constexpr float kDiagonal = std::numbers::sqrt2_v<float>;
constexpr std::array<Neighbour, 8> kNeighbours{{{1, 0, 1.0F},
                                                {0, 1, 1.0F},
                                                {-1, 0, 1.0F},
                                                {0, -1, 1.0F},
                                                {1, 1, kDiagonal},
                                                {-1, 1, kDiagonal},
                                                {-1, -1, kDiagonal},
                                                {1, -1, kDiagonal}}};

/// Calls visit(neighbour, distance) for all free cells beside @p cell; corners are not cut.
template <class Visit>
void visitNeighbours(const FieldGrid& grid, const std::vector<std::uint8_t>& isFree,
                     std::size_t cell, Visit visit) {
  constexpr std::ptrdiff_t kNone = -1;
  const Place place = placeOf(grid, cell);
  const auto freeAt = [&](std::ptrdiff_t column, std::ptrdiff_t row) {
    if (column < 0 || row < 0 || column >= grid.columns || row >= grid.rows) return kNone;
    const std::ptrdiff_t index = row * grid.columns + column;
    return isFree[static_cast<std::size_t>(index)] != 0 ? index : kNone;
  };
  for (const Neighbour& n : kNeighbours) {
    const std::ptrdiff_t next = freeAt(place.column + n.column, place.row + n.row);
    if (next == kNone) continue;
    if (n.column != 0 && n.row != 0 &&
        (freeAt(place.column + n.column, place.row) == kNone ||
         freeAt(place.column, place.row + n.row) == kNone))
      continue;
    visit(static_cast<std::size_t>(next), n.way);
  }
}

}  // namespace

RoutePlanner::~RoutePlanner() = default;

RoutePlanner::RoutePlanner(const SimWorld& world, const RobotSize& robot, double clearance) {
  FieldRegion region = coarseRegion(world, {robot.radius + clearance, robot.height});
  if (!hasRoom(region)) region = coarseRegion(world, robot);
  if (!hasRoom(region))
    throw std::invalid_argument("world " + world.name() + ": a robot of radius " +
                                std::to_string(robot.radius) + " m fits nowhere");
  const FieldParts parts = floorParts(world, region, robot);  // the same parts as the learner's
  grid_ = region.grid;
  free_ = parts.only(mainPart(world, parts)).standable;
  keepLargestPart();
}

void RoutePlanner::keepLargestPart() {
  std::vector<std::uint8_t> seen(free_.size(), 0);
  for (std::size_t start = 0; start < free_.size(); ++start) {
    if (free_[start] == 0 || seen[start] != 0) continue;
    std::vector<std::uint32_t> part{static_cast<std::uint32_t>(start)};
    seen[start] = 1;
    for (std::size_t done = 0; done < part.size(); ++done)
      visitNeighbours(grid_, free_, part[done], [&](std::size_t next, float) {
        if (seen[next] != 0) return;
        seen[next] = 1;
        part.push_back(static_cast<std::uint32_t>(next));
      });
    if (part.size() > cells_.size()) cells_.swap(part);
  }
  std::sort(cells_.begin(), cells_.end());
  std::fill(free_.begin(), free_.end(), std::uint8_t{0});
  for (const std::uint32_t cell : cells_) free_[cell] = 1;
}

bool RoutePlanner::contains(double x, double y) const {
  const std::ptrdiff_t cell = grid_.cellAt(x, y);
  return cell >= 0 && free_[static_cast<std::size_t>(cell)] != 0;
}

Pose2 RoutePlanner::randomPose(Random& random) const {
  const FloorPoint point = centre(cells_[random.below(cells_.size())]);
  return {point.x, point.y, wrapAngle(random.uniform(-std::numbers::pi, std::numbers::pi))};
}

std::size_t RoutePlanner::nearestCell(const FloorPoint& point) const {
  if (contains(point.x, point.y)) return static_cast<std::size_t>(grid_.cellAt(point.x, point.y));
  std::size_t best = cells_.front();
  double bestDistance = std::numeric_limits<double>::infinity();
  for (const std::uint32_t cell : cells_) {
    const FloorPoint there = centre(cell);
    const double away = std::hypot(there.x - point.x, there.y - point.y);
    if (away >= bestDistance) continue;
    best = cell;
    bestDistance = away;
  }
  return best;
}

bool RoutePlanner::isClear(std::size_t a, std::size_t b) const {
  const FloorPoint from = centre(a);
  const FloorPoint to = centre(b);
  const double way = std::hypot(to.x - from.x, to.y - from.y);
  const int steps = static_cast<int>(std::ceil(way / (grid_.cell / 4.0)));
  for (int i = 1; i < steps; ++i) {
    const double share = static_cast<double>(i) / steps;
    if (!contains(from.x + share * (to.x - from.x), from.y + share * (to.y - from.y))) return false;
  }
  return true;
}

/// Searches by A*. @returns the cells from @p to back to @p from
std::vector<std::uint32_t> RoutePlanner::search(std::size_t from, std::size_t to) const {
  constexpr std::uint32_t kNone = 0xFFFFFFFF;
  std::vector<std::uint32_t> previous(free_.size(), kNone);
  std::vector<float> way(free_.size(), std::numeric_limits<float>::infinity());
  const Place goal = placeOf(grid_, to);
  const auto ahead = [&](std::size_t cell) {
    const Place place = placeOf(grid_, cell);
    const auto dx = static_cast<float>(std::abs(place.column - goal.column));
    const auto dy = static_cast<float>(std::abs(place.row - goal.row));
    return std::max(dx, dy) + (kDiagonal - 1.0F) * std::min(dx, dy);
  };
  using Entry = std::pair<float, std::uint32_t>;  // ties are broken by the cell: deterministic
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
  way[from] = 0.0F;
  open.emplace(ahead(from), static_cast<std::uint32_t>(from));
  while (!open.empty() && open.top().second != to) {
    const Entry entry = open.top();
    const std::uint32_t here = entry.second;
    open.pop();
    if (entry.first > way[here] + ahead(here)) continue;  // a shorter route has been found since
    visitNeighbours(grid_, free_, here, [&](std::size_t next, float step) {
      if (way[here] + step >= way[next]) return;
      way[next] = way[here] + step;
      previous[next] = here;
      open.emplace(way[next] + ahead(next), static_cast<std::uint32_t>(next));
    });
  }
  std::vector<std::uint32_t> cells;
  for (auto cell = static_cast<std::uint32_t>(to); cell != kNone; cell = previous[cell])
    cells.push_back(cell);
  return cells;
}

std::vector<FloorPoint> RoutePlanner::route(const FloorPoint& from, const FloorPoint& to) const {
  std::vector<std::uint32_t> cells = search(nearestCell(from), nearestCell(to));
  std::reverse(cells.begin(), cells.end());
  std::vector<FloorPoint> corners;
  if (!contains(from.x, from.y)) corners.push_back(centre(cells.front()));
  // The route is shortened: from each corner it goes straight to the farthest cell in sight.
  std::size_t corner = 0;
  while (corner + 1 < cells.size()) {
    std::size_t next = corner + 1;
    while (next + 1 < cells.size() && isClear(cells[corner], cells[next + 1])) ++next;
    corners.push_back(centre(cells[next]));
    corner = next;
  }
  return corners;
}

}  // namespace ortung

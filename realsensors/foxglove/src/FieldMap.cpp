#include "FieldMap.hpp"

#include <algorithm>
#include <cmath>

namespace ortung::foxglove {
namespace {

constexpr double kFinest = 0.05;         // least size of a cell [m]
constexpr double kMostCells = 1U << 17;  // greatest number of cells; each client has a map
constexpr double kFarthest = 1e5;        // greatest width and height of a field [m]
constexpr double kMargin = 0.5;          // margin around the bounds, for the walls' thickness [m]
constexpr std::int8_t kOccupied = 100;

/// Marks the cells on a wall.
void mark(const BoardReply& wall, ros2::OccupancyGrid& map) {
  const auto x0 = wall.real("x0_m");
  const auto y0 = wall.real("y0_m");
  const auto x1 = wall.real("x1_m");
  const auto y1 = wall.real("y1_m");
  if (!x0 || !y0 || !x1 || !y1) return;
  const auto cell = static_cast<double>(map.resolution);
  const double length = std::min(std::hypot(*x1 - *x0, *y1 - *y0), 2 * kFarthest);
  const double steps = std::ceil(2.0 * length / cell);
  for (double i = 0; i <= steps; ++i) {
    const double share = steps > 0 ? i / steps : 0.0;
    const double column = std::floor((*x0 + share * (*x1 - *x0) - map.origin.position.x) / cell);
    const double row = std::floor((*y0 + share * (*y1 - *y0) - map.origin.position.y) / cell);
    if (column < 0 || row < 0 || column >= map.width || row >= map.height) continue;
    map.data[static_cast<std::size_t>(row) * map.width + static_cast<std::size_t>(column)] =
        kOccupied;
  }
}

}  // namespace

std::optional<ros2::OccupancyGrid> mapOfField(const BoardReply& world,
                                              const std::vector<std::string>& lines) {
  const auto xLow = world.real("x_min_m");
  const auto yLow = world.real("y_min_m");
  const auto xHigh = world.real("x_max_m");
  const auto yHigh = world.real("y_max_m");
  if (!xLow || !yLow || !xHigh || !yHigh) return std::nullopt;
  const double width = *xHigh - *xLow + 2 * kMargin;
  const double height = *yHigh - *yLow + 2 * kMargin;
  if (!(width > 0 && height > 0 && width < kFarthest && height < kFarthest)) return std::nullopt;
  const double cell = std::max(kFinest, std::sqrt(width * height / kMostCells));
  ros2::OccupancyGrid map;
  map.header.frame = "map";
  map.resolution = static_cast<float>(cell);
  map.width = static_cast<std::uint32_t>(std::ceil(width / cell));
  map.height = static_cast<std::uint32_t>(std::ceil(height / cell));
  map.origin.position = {*xLow - kMargin, *yLow - kMargin, 0.0};
  map.data.assign(static_cast<std::size_t>(map.width) * map.height, 0);
  for (const std::string& line : lines) {
    const BoardReply parsed = parseBoardLine(line);
    if (!parsed.words.empty() && parsed.words[0] == "wall") mark(parsed, map);
  }
  const bool isAny = std::find(map.data.begin(), map.data.end(), kOccupied) != map.data.end();
  return isAny ? std::optional(std::move(map)) : std::nullopt;
}

}  // namespace ortung::foxglove

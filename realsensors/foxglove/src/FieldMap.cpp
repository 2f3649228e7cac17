#include "FieldMap.hpp"

#include <algorithm>
#include <cmath>

namespace ortung::foxglove {
namespace {

constexpr double kFinest = 0.05;   // least size of a cell [m]
constexpr double kFarthest = 1e5;  // greatest width and height of a field [m]
constexpr double kMargin = 0.5;    // margin around the bounds, for the walls' thickness [m]
constexpr std::int8_t kOccupied = 100;

struct Point {
  double x = 0.0, y = 0.0;  ///< [m]
};

/// Draws surfaces into a map.
class Drawing {
 public:
  Drawing(ros2::OccupancyGrid& map, bool isBehind) : map_(map), isBehind_(isBehind) {}
  /// @param from, to a surface with its solid on the right of the way
  void add(Point from, Point to) {
    const auto cell = static_cast<double>(map_.resolution);
    const double whole = std::hypot(to.x - from.x, to.y - from.y);
    if (isBehind_ && whole > 0.0) {
      const Point shift{(to.y - from.y) / whole * cell / 2, (from.x - to.x) / whole * cell / 2};
      for (Point* end : {&from, &to}) *end = {end->x + shift.x, end->y + shift.y};
    }
    const double steps = std::ceil(2.0 * std::min(whole, 2 * kFarthest) / cell);
    for (double i = 0; i <= steps; ++i) {
      const double share = steps > 0 ? i / steps : 0.0;
      mark({from.x + share * (to.x - from.x), from.y + share * (to.y - from.y)});
    }
  }

 private:
  void mark(const Point& point) {
    const auto cell = static_cast<double>(map_.resolution);
    const double column = std::floor((point.x - map_.origin.position.x) / cell);
    const double row = std::floor((point.y - map_.origin.position.y) / cell);
    if (column < 0 || row < 0 || column >= map_.width || row >= map_.height) return;
    map_.data[static_cast<std::size_t>(row) * map_.width + static_cast<std::size_t>(column)] =
        kOccupied;
  }

  ros2::OccupancyGrid& map_;
  bool isBehind_;
};

/// The corners "X,Y" of a solid; none if one of them is no point.
std::vector<Point> cornersOf(const BoardReply& solid) {
  std::vector<Point> corners;
  for (const std::string& word : solid.words) {
    const std::size_t comma = word.find(',');
    if (comma == word.npos) continue;
    const BoardReply point =
        parseBoardLine("x=" + word.substr(0, comma) + " y=" + word.substr(comma + 1));
    const auto x = point.real("x");
    const auto y = point.real("y");
    if (!x || !y) return {};
    corners.push_back({*x, *y});
  }
  return corners;
}

/// Adds the sides of a solid, clockwise, so that it is on their right.
void addSolid(std::vector<Point> corners, Drawing& drawing) {
  double area = 0.0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Point& next = corners[(i + 1) % corners.size()];
    area += corners[i].x * next.y - next.x * corners[i].y;
  }
  if (area > 0.0) std::reverse(corners.begin(), corners.end());
  for (std::size_t i = 0; i < corners.size(); ++i)
    drawing.add(corners[i], corners[(i + 1) % corners.size()]);
}

void addLine(const BoardReply& line, const FieldMapOptions& options, Drawing& drawing) {
  if (line.words.empty()) return;
  const double low = line.real("z0_m").value_or(-kFarthest);
  const double high = line.real("z1_m").value_or(kFarthest);
  if (options.height && (*options.height < low || *options.height > high)) return;
  if (line.words[0] == "solid") return addSolid(cornersOf(line), drawing);
  if (line.words[0] != "wall") return;
  const auto x0 = line.real("x0_m");
  const auto y0 = line.real("y0_m");
  const auto x1 = line.real("x1_m");
  const auto y1 = line.real("y1_m");
  if (x0 && y0 && x1 && y1) drawing.add({*x0, *y0}, {*x1, *y1});
}

}  // namespace

std::optional<ros2::OccupancyGrid> mapOfField(const BoardReply& world,
                                              const std::vector<std::string>& lines,
                                              const FieldMapOptions& options) {
  const auto xLow = world.real("x_min_m");
  const auto yLow = world.real("y_min_m");
  const auto xHigh = world.real("x_max_m");
  const auto yHigh = world.real("y_max_m");
  if (!xLow || !yLow || !xHigh || !yHigh) return std::nullopt;
  const double width = *xHigh - *xLow + 2 * kMargin;
  const double height = *yHigh - *yLow + 2 * kMargin;
  if (!(width > 0 && height > 0 && width < kFarthest && height < kFarthest)) return std::nullopt;
  const double cell =
      std::max(kFinest, std::sqrt(width * height / static_cast<double>(options.mostCells)));
  ros2::OccupancyGrid map;
  map.header.frame = "map";
  map.resolution = static_cast<float>(cell);
  map.width = static_cast<std::uint32_t>(std::ceil(width / cell));
  map.height = static_cast<std::uint32_t>(std::ceil(height / cell));
  map.origin.position = {*xLow - kMargin, *yLow - kMargin, 0.0};
  map.data.assign(static_cast<std::size_t>(map.width) * map.height, 0);
  Drawing drawing(map, options.isBehindSurfaces);
  for (const std::string& line : lines) addLine(parseBoardLine(line), options, drawing);
  const bool isAny = std::find(map.data.begin(), map.data.end(), kOccupied) != map.data.end();
  return isAny ? std::optional(std::move(map)) : std::nullopt;
}

}  // namespace ortung::foxglove

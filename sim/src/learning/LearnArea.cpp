#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>

#include "FloorParts.hpp"
#include "ortung/robot/TomlFile.hpp"
#include "ortung/sim/Learner.hpp"

namespace ortung {
namespace {

/// Returns the part of the field in which a point lies. @throws std::invalid_argument if there is
/// none
std::size_t partAround(const std::array<double, 2>& point, const FieldParts& parts) {
  const auto found = parts.partAt(point[0], point[1]);
  if (!found || parts.parts()[*found].cells == 0)
    throw std::invalid_argument("there is no room for the robot around (" +
                                std::to_string(point[0]) + ", " + std::to_string(point[1]) + ") m");
  return *found;
}

/// Returns a region's columns from `from` to `to`; of its cells only which are standable.
FieldRegion cutOut(const FieldRegion& region, int from, int to) {
  FieldRegion part;
  part.grid = region.grid;
  part.grid.originX += from * region.grid.cell;
  part.grid.columns = to - from;
  for (int row = 0; row < region.grid.rows; ++row) {
    const auto begin = region.standable.begin() + std::ptrdiff_t{row} * region.grid.columns;
    part.standable.insert(part.standable.end(), begin + from, begin + to);
  }
  return part;
}

/// Returns the cells of the main part of each floor of a building.
FieldRegion mainParts(const SimWorld& world, const FieldRegion& whole, const RobotSize& robot) {
  FieldRegion main = whole;
  std::fill(main.standable.begin(), main.standable.end(), std::uint8_t{0});
  const FieldRegion passable = passableIn(world, whole, robot);
  const FieldGrid& grid = whole.grid;
  int from = 0;
  for (const Floor& floor : whole.building.floors) {
    const double end = std::round((floor.xHigh - grid.originX) / grid.cell);
    const int to = static_cast<int>(std::clamp(end, 0.0, static_cast<double>(grid.columns)));
    const FieldRegion part = cutOut(whole, from, to);
    const FieldParts parts(part, cutOut(passable, from, to).standable);
    if (!parts.parts().empty()) {
      const FieldRegion its = parts.only(mainPart(world, parts));
      for (int row = 0; row < grid.rows; ++row)
        std::copy_n(its.standable.begin() + std::ptrdiff_t{row} * (to - from), to - from,
                    main.standable.begin() + std::ptrdiff_t{row} * grid.columns + from);
    }
    from = to;
  }
  return main;
}

/// Reads a point "x;y". @throws std::invalid_argument
std::array<double, 2> pointIn(const std::string& text) {
  std::array<double, 2> point{};
  const char* const end = text.data() + text.size();
  const auto x = std::from_chars(text.data(), end, point[0]);
  const bool isParted = x.ec == std::errc() && x.ptr != end && *x.ptr == ';';
  const auto y = isParted ? std::from_chars(x.ptr + 1, end, point[1]) : x;
  if (!isParted || y.ec != std::errc() || y.ptr != end)
    throw std::invalid_argument("area is '" + text + "', expected auto, all or x;y in metres");
  return point;
}

}  // namespace

LearnArea learnArea(const SimWorld& world, double cell, const RobotSize& robot,
                    const std::optional<std::array<double, 2>>& inside) {
  const FieldRegion whole = world.region(cell, robot);
  whole.check();
  LearnArea area;
  if (!inside && !whole.building.isEmpty()) {
    area.region = mainParts(world, whole, robot);
  } else {
    const FieldParts parts = floorParts(world, whole, robot);
    area.region = parts.only(inside ? partAround(*inside, parts) : mainPart(world, parts));
  }
  for (std::size_t i = 0; i < whole.standable.size(); ++i)
    area.leftOut += whole.standable[i] != area.region.standable[i] ? cell * cell : 0.0;
  return area;
}

LearnArea learnAreaOf(const SimWorld& world, double cell, const RobotSize& robot,
                      const std::string& part) {
  if (part == "all") {
    LearnArea all{world.region(cell, robot), 0.0};
    all.region.check();
    return all;
  }
  std::optional<std::array<double, 2>> inside;
  if (part != "auto") inside = pointIn(part);
  return learnArea(world, cell, robot, inside);
}

TableInfo tableInfoOf(const SimWorld& world, const RobotConfig& robot, const FieldRegion& region,
                      const LearnOptions& options) {
  TableInfo info;
  info.world = world.name();
  info.worldFingerprint = world.fingerprint();
  info.robot = robot.about.textOr("name", robot.name);
  info.headingStep = options.headingStep;
  info.region = region;
  info.field = fieldModelOf(world);
  info.robotToml = readTomlText(robot.about.where());
  return info;
}

}  // namespace ortung

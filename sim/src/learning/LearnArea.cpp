#include <charconv>
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
  const FieldParts parts = floorParts(world, whole, robot);
  const std::size_t part = inside ? partAround(*inside, parts) : mainPart(world, parts);
  LearnArea area{parts.only(part), 0.0};
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

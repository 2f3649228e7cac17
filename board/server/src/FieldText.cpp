#include "ortung/server/FieldText.hpp"

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <utility>

namespace ortung {
namespace {

constexpr std::size_t kMostWalls = 20'000;

std::string lineText(const FieldLine& line) {
  std::string text = line.shape == FieldLine::Shape::kStraight
                         ? "line" + keyValue("x0_m", line.x0) + keyValue("y0_m", line.y0) +
                               keyValue("x1_m", line.x1) + keyValue("y1_m", line.y1)
                         : "arc" + keyValue("x_m", line.x) + keyValue("y_m", line.y) +
                               keyValue("rx_m", line.radiusX) + keyValue("ry_m", line.radiusY) +
                               keyValue("angle_rad", line.angle) + keyValue("from_rad", line.from) +
                               keyValue("to_rad", line.to);
  return text + keyValue("width_m", line.width) + colourText(line.colour);
}

std::string wallText(const FieldWall& wall) {
  return "wall" + keyValue("x0_m", wall.x0) + keyValue("y0_m", wall.y0) +
         keyValue("x1_m", wall.x1) + keyValue("y1_m", wall.y1) + keyValue("z0_m", wall.zLow) +
         keyValue("z1_m", wall.zHigh) + (wall.ofGoal ? " goal=1" : "");
}

/// Returns a world file's name as one word.
std::string wordOf(std::string name) {
  std::replace(name.begin(), name.end(), ' ', '_');
  return name;
}

std::string goalText(const FieldGoal& goal) {
  return "goal name=" + wordOf(goal.name.empty() ? "goal" : goal.name) +
         keyValue("x_m", goal.pose.x) + keyValue("y_m", goal.pose.y) +
         keyValue("theta_rad", goal.pose.theta) + keyValue("dx_m", goal.halfX) +
         keyValue("dy_m", goal.halfY) + keyValue("height_m", goal.zHigh) + colourText(goal.colour);
}

constexpr std::size_t kMostCells = 250'000;
constexpr std::size_t kMostFloorBytes = 256u << 10;
constexpr std::size_t kLongestRuns = 700;  // bytes in a line: replies cut longer ones

/// Joins four cells to one, which is open if one of them is.
void halve(FieldGrid& grid, std::vector<std::uint8_t>& open) {
  FieldGrid coarse{grid.originX, grid.originY, 2.0 * grid.cell, (grid.columns + 1) / 2,
                   (grid.rows + 1) / 2};
  std::vector<std::uint8_t> joined(coarse.size(), 0);
  const auto columns = static_cast<std::size_t>(grid.columns);
  for (std::size_t i = 0; i < open.size(); ++i)
    if (open[i] != 0)
      joined[i / columns / 2 * static_cast<std::size_t>(coarse.columns) + i % columns / 2] = 1;
  grid = coarse;
  open = std::move(joined);
}

/// Lines of runs of cells that are alike, in turn closed and open.
std::vector<std::string> runsOf(const FieldGrid& grid, const std::vector<std::uint8_t>& open) {
  const std::string head = "open" + keyValue("x_min_m", grid.originX) +
                           keyValue("y_min_m", grid.originY) + keyValue("step_m", grid.cell) +
                           keyValue("columns", grid.columns) + keyValue("rows", grid.rows);
  std::vector<std::string> lines;
  std::string runs;
  std::size_t begin = 0;  // of the line
  std::uint8_t kind = 0;  // of the run that is next
  for (std::size_t i = 0; i < open.size();) {
    const std::size_t from = i;
    while (i < open.size() && (open[i] != 0) == (kind != 0)) ++i;
    runs += (runs.empty() ? "" : ",") + std::to_string(i - from);
    kind ^= 1U;
    if (i < open.size() && (runs.size() < kLongestRuns || kind != 0)) continue;
    lines.push_back(head + " from=" + std::to_string(begin) + " " + runs);
    runs.clear();
    begin = i;
  }
  return lines;
}

std::string number(double value) {
  char digits[32];
  const std::to_chars_result end = std::to_chars(digits, digits + sizeof digits, value);
  return {digits, end.ptr};
}

}  // namespace

std::string colourText(const std::string& colour) {
  return colour.empty() ? "" : " colour=" + colour;
}

std::string keyValue(const char* key, double value) {
  return std::string(" ").append(key).append("=").append(number(value));
}

std::vector<std::string> fieldText(const FieldModel& field) {
  std::vector<std::string> lines;
  for (const FieldLine& line : field.lines) lines.push_back(lineText(line));
  for (const FieldWall& wall : field.walls) {  // the longest ones come first
    if (lines.size() >= field.lines.size() + kMostWalls) break;
    lines.push_back(wallText(wall));
  }
  for (const FieldGoal& goal : field.goals) lines.push_back(goalText(goal));
  for (const Landmark& landmark : field.landmarks)
    lines.push_back("landmark kind=" + wordOf(landmark.kind) +
                    " id=" + std::to_string(landmark.identity) + keyValue("x_m", landmark.x) +
                    keyValue("y_m", landmark.y) + keyValue("z_m", landmark.z));
  return lines;
}

std::vector<std::string> floorText(FieldGrid grid, std::vector<std::uint8_t> open) {
  if (grid.columns <= 0 || grid.rows <= 0 || open.size() != grid.size()) return {};
  while (grid.size() > kMostCells) halve(grid, open);
  for (;; halve(grid, open)) {
    std::vector<std::string> lines = runsOf(grid, open);
    std::size_t bytes = 0;
    for (const std::string& line : lines) bytes += line.size() + 1;
    if (bytes <= kMostFloorBytes) return lines;
  }
}

bool isFloor(const FieldModel& field) { return field.lines.empty() && field.goals.empty(); }

}  // namespace ortung

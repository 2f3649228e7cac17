#include "ortung/server/FieldText.hpp"

#include <algorithm>
#include <charconv>

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

}  // namespace ortung

#include "MapWorld.hpp"

#include <cmath>
#include <cstdint>

#include "FrameTree.hpp"
#include "ortung/base/NewFile.hpp"
#include "ortung/realsensors/LogFile.hpp"
#include "ortung/realsensors/LogSource.hpp"
#include "ortung/realsensors/MapFiles.hpp"
#include "ortung/ros2/RobotTopics.hpp"

namespace ortung::ros2 {
namespace {

/// Returns how much the normal of the floor is turned away from upright, as a cosine.
double uprightness(const Quaternion& q) {
  const double length = q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w;
  return 1.0 - 2.0 * (q.x * q.x + q.y * q.y) / length;
}

/// Returns the pose of the lower left corner. Some leave out the rotation, all zeros: none.
Pose originOf(const OccupancyGrid& map) {
  Pose origin = map.origin;
  const Quaternion& q = origin.orientation;
  if (q.x == 0.0 && q.y == 0.0 && q.z == 0.0 && q.w == 0.0) origin.orientation = {0, 0, 0, 1};
  return origin;
}

}  // namespace

std::string whyNoWorld(const OccupancyGrid& map) {
  const Pose place = originOf(map);
  const Pose2 origin = toPose2(place);
  constexpr double kLevel = 0.9998;  // cosine of some degree
  const bool isGrid = map.resolution > 0.0F && map.resolution <= 100.0F && isPlausible(origin) &&
                      map.width > 0 && map.height > 0 &&
                      map.data.size() / map.width == map.height && map.data.size() % map.width == 0;
  if (isGrid && uprightness(place.orientation) >= kLevel) return "";
  return "found a map of " + std::to_string(map.width) + " x " + std::to_string(map.height) +
         " cells of " + std::to_string(map.resolution) + " m with " +
         std::to_string(map.data.size()) + " values, turned by " + std::to_string(origin.theta) +
         " rad, expected a value a cell, lying on the floor";
}

void writeWorldOf(const OccupancyGrid& map, const std::filesystem::path& file) {
  constexpr int kOccupiedFrom = 65;  // as map_server's own map_saver has it
  constexpr int kOccupiedTo = 100;
  constexpr int kFreeTo = 25;
  constexpr char kOccupied = 0;
  constexpr char kUnknown = static_cast<char>(205);
  constexpr char kFree = static_cast<char>(254);
  std::string picture =
      "P5\n" + std::to_string(map.width) + " " + std::to_string(map.height) + "\n255\n";
  for (std::size_t row = map.height; row-- > 0;) {
    for (std::size_t column = 0; column < map.width; ++column) {
      const std::int8_t value = map.data[row * map.width + column];
      const bool isKnown = value >= 0 && value <= kOccupiedTo;
      picture += isKnown && value >= kOccupiedFrom ? kOccupied
                 : isKnown && value <= kFreeTo     ? kFree
                                                   : kUnknown;
    }
  }
  const double yaw = toPose2(originOf(map)).theta;
  std::filesystem::path image = file;
  image.replace_extension(".pgm");
  std::filesystem::path yaml = file;
  yaml.replace_extension(".yaml");
  writeFile(image, picture);
  writeFile(yaml, "image: " + image.filename().string() + "\nresolution: " +
                      tomlNumber(plain(static_cast<double>(map.resolution))) + "\norigin: [" +
                      tomlNumber(map.origin.position.x) + ", " + tomlNumber(map.origin.position.y) +
                      ", " + (yaw == 0.0 ? "0" : tomlNumber(yaw)) +
                      "]\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n");
  writeFile(file, "[world]\nname = " + tomlText(file.stem().string()) + "\n\n" +
                      gridToml(yaml.filename().string()));
}

}  // namespace ortung::ros2

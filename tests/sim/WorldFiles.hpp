#pragma once

#include <stdlib.h>

#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <vector>

#include "ortung/base/Parameters.hpp"
#include "ortung/sim/SimWorld.hpp"

namespace ortung::test {

/// A folder of its own for one test, gone with it.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "ortung-world-XXXXXX").string();
    path_ = ::mkdtemp(name.data());
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  std::filesystem::path write(const std::string& name, const std::string& content) const {
    const auto file = path_ / name;
    std::ofstream(file, std::ios::binary) << content;
    return file;
  }
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// The world that a TOML text describes.
inline std::unique_ptr<SimWorld> worldOf(const std::string& toml) {
  const TemporaryFolder folder;
  return readWorld(folder.write("world.toml", toml));
}

/// The message with which a world file is refused, or "" if it is not.
inline std::string refusalOf(const std::filesystem::path& file) {
  try {
    readWorld(file);
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "";
}
inline std::string refusalOf(const std::string& toml) {
  const TemporaryFolder folder;
  return refusalOf(folder.write("world.toml", toml));
}

/// A robot that is an upright cylinder, far away from everything.
inline RobotNumber addRobot(SimWorld& world, double radius, double height) {
  Primitive circle;
  circle.shape = Primitive::Shape::kEllipse;
  circle.kind = "robot";
  circle.halfX = circle.halfY = radius;
  circle.zHigh = height;
  return world.addBody({.kind = "robot", .name = {}, .colour = {}, .pieces = {circle}},
                       {9000.0, 9000.0, 0.0});
}

/// Range of one ray [m].
inline double rangeAt(const World& world, double x, double y, double angle, double z = 0.3,
                      double maxRange = 50.0, RobotNumber ignore = 0) {
  float range = -1.0f;
  world.castFan({.x = x,
                 .y = y,
                 .z = z,
                 .firstAngle = angle,
                 .angleStep = 0.01,
                 .elevation = 0.0,
                 .maxRange = maxRange},
                ignore, {&range, 1});
  return static_cast<double>(range);
}

/// A binary PGM; rows from top to bottom: '#' occupied (0), '.' free (254), ' ' unknown (205).
inline std::string pgmOf(const std::vector<std::string>& rows) {
  std::string image =
      "P5\n" + std::to_string(rows[0].size()) + " " + std::to_string(rows.size()) + "\n255\n";
  for (const std::string& row : rows)
    for (const char c : row) image += c == '#' ? '\0' : c == '.' ? '\xfe' : '\xcd';
  return image;
}

inline std::string mapYaml(const std::string& image = "map.pgm",
                           const std::string& origin = "[0, 0, 0]",
                           const std::string& resolution = "0.5") {
  return "image: " + image + "\nresolution: " + resolution + "\norigin: " + origin +
         "\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n";
}

inline std::string gridWorld(const std::string& map = "map.yaml", const std::string& more = "") {
  return "[[grid]]\nmap = \"" + map + "\"\n" + more;
}

}  // namespace ortung::test

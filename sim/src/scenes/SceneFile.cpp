#include <algorithm>

#include "GridMap.hpp"
#include "PrimitiveFile.hpp"
#include "ReadTables.hpp"
#include "ortung/base/Angles.hpp"
#include "ortung/base/FileKind.hpp"
#include "ortung/robot/TomlFile.hpp"
#include "ortung/sim/Scene.hpp"

namespace ortung {
namespace {

constexpr std::size_t kMostCommands = 65536;
constexpr Range kTime{0.0, 1e6};               ///< times [s]
constexpr Range kVelocity{-100.0, 100.0};      ///< velocities [m/s]
constexpr Range kTurnRate{-36000.0, 36000.0};  ///< turn rates [degree/s]

Pose2 readPose(const Parameters& table) {
  Pose2 pose;
  pose.x = table.number("x_m", kCoordinate);
  pose.y = table.number("y_m", kCoordinate);
  pose.theta = wrapAngle(radians(table.numberOr("theta_deg", 0.0, {-3600.0, 3600.0})));
  table.refuseUnread();
  return pose;
}

std::filesystem::path readPath(const Parameters& table, const std::string& key,
                               const std::filesystem::path& folder) {
  const std::string path = table.text(key);
  if (path.empty() || path.find('\0') != std::string::npos) table.fail(key, "names no file");
  return folder / path;
}

SceneRobot readRobotOf(const Parameters& table, const std::filesystem::path& folder) {
  SceneRobot robot;
  robot.file = readPath(table, "file", folder);
  robot.name = table.text("name");
  if (!isWord(robot.name))
    table.fail("name", "is \"" + robot.name + "\", expected [A-Za-z0-9_-]{1,64}");
  if (table.has("start")) robot.start = readPose(table.table("start"));
  robot.wanders = table.flagOr("wanders", false);
  const auto points = table.numbersOr("waypoints_m", {}, -1, kCoordinate);
  if (points.size() % 2 != 0) table.fail("waypoints_m", "must be x1, y1, x2, y2, ...");
  for (std::size_t i = 0; i < points.size(); i += 2)
    robot.waypoints.push_back({points[i], points[i + 1]});
  if (robot.wanders && !robot.waypoints.empty())
    table.fail("waypoints_m", "is given beside wanders; expected one of the two");
  if (table.has("speed_m_s")) robot.speed = table.number("speed_m_s", {0.0, 100.0});
  for (const double seconds : table.numbersOr("kidnap_s", {}, -1, kTime)) {
    robot.kidnaps.push_back(fromSeconds(seconds));
    if (robot.kidnaps.size() > 1 && robot.kidnaps.back() <= robot.kidnaps.end()[-2])
      table.fail("kidnap_s", "must be rising times");
  }
  table.refuseUnread();
  return robot;
}

void addRobot(const Parameters& table, const std::filesystem::path& folder,
              std::vector<SceneRobot>& robots) {
  SceneRobot robot = readRobotOf(table, folder);
  for (const SceneRobot& other : robots)
    if (other.name == robot.name)
      table.fail("name", "is given twice: " + robot.name + ", expected a name of its own");
  robots.push_back(std::move(robot));
}

SceneCommand readCommand(const Parameters& table) {
  SceneCommand command;
  command.at = fromSeconds(table.number("at_s", kTime));
  command.robot = table.text("robot");
  if (table.has("translational_m_s"))
    command.translational = table.number("translational_m_s", kVelocity);
  if (table.has("rotational_deg_s"))
    command.rotational = radians(table.number("rotational_deg_s", kTurnRate));
  command.vector = table.numbersOr("command", {}, -1, {-1e6, 1e6});
  command.manipulator = table.textOr("manipulator", "");
  if (!command.manipulator.empty()) command.state = table.text("state");
  table.refuseUnread();
  return command;
}

ScenePlacement readPlacement(const Parameters& table) {
  ScenePlacement placement;
  placement.at = fromSeconds(table.numberOr("at_s", 0.0, kTime));
  placement.thing = table.text("name");
  placement.pose = readPose(table.table("pose"));
  const auto velocity = table.numbersOr("velocity_m_s", {0.0, 0.0}, 2, kVelocity);
  placement.velocity = {velocity[0], velocity[1],
                        radians(table.numberOr("rotational_deg_s", 0.0, kTurnRate))};
  table.refuseUnread();
  return placement;
}

}  // namespace

bool Scene::isScene(const std::filesystem::path& file) {
  const FileKind kind = kindOfFile(file);
  if (kind != FileKind::kUnknown || isGridMap(file)) return kind == FileKind::kScene;
  return readToml(file).has("scene");
}

Scene Scene::open(const std::filesystem::path& file) {
  const FileKind kind = kindOfFile(file);
  if (kind == FileKind::kScene) return read(file);
  if (kind == FileKind::kUnknown && !isGridMap(file))
    if (const Parameters toml = readToml(file); toml.has("scene"))
      return read(toml, file.parent_path());
  Scene scene;
  scene.world = file;
  return scene;
}

Scene Scene::read(const std::filesystem::path& file) {
  return read(readToml(file), file.parent_path());
}

Scene Scene::read(const Parameters& toml, const std::filesystem::path& folder) {
  Scene scene;
  const Parameters about = toml.table("scene");
  scene.world = readPath(about, "world", folder);
  if (about.has("duration_s")) scene.duration = about.number("duration_s", kTime);
  for (const Parameters& table : readTables(toml, "robot", Scene::kMostRobots))
    addRobot(table, folder, scene.robots);
  for (const Parameters& table :
       readTables(toml, "player", Scene::kMostRobots - scene.robots.size()))
    scene.players.push_back(readPlayer(table, folder));
  if (toml.has("referee")) {
    const Parameters table = toml.table("referee");
    scene.referee = RefereeWish{table.text("plugin"), table.takeTable("options")};
  }
  if (scene.robots.empty() && scene.players.empty())
    toml.fail("robot", "is missing: a scene has at least one [[robot]] or [[player]]");
  for (const Parameters& table : readTables(toml, "command", kMostCommands))
    scene.commands.push_back(readCommand(table));
  for (const Parameters& table : readTables(toml, "thing", kMostCommands))
    scene.placements.push_back(readPlacement(table));
  const auto earlier = [](const auto& a, const auto& b) { return a.at < b.at; };
  std::stable_sort(scene.commands.begin(), scene.commands.end(), earlier);
  std::stable_sort(scene.placements.begin(), scene.placements.end(), earlier);
  toml.refuseUnread();
  return scene;
}

}  // namespace ortung

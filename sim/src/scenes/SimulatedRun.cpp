#include "ortung/sim/SimulatedRun.hpp"

#include <charconv>
#include <optional>
#include <string_view>

#include "ortung/core/SourceOptions.hpp"
#include "ortung/robot/RobotFile.hpp"

namespace ortung {
namespace {

constexpr double kUsualDuration = 60.0;  ///< default duration [s]

std::uint64_t seedOption(const Parameters& p) {
  if (!p.has("seed")) return 1;
  const std::string text = p.text("seed");
  std::uint64_t seed = 0;
  const auto [rest, error] = std::from_chars(text.data(), text.data() + text.size(), seed);
  if (text.empty() || error != std::errc{} || rest != text.data() + text.size())
    p.fail("seed", "is \"" + text + "\", must be a whole number in [0, 2^64)");
  return seed;
}

std::vector<FloorPoint> waypointsOption(const Parameters& p) {
  std::vector<FloorPoint> points;
  if (!p.has("waypoints")) return points;
  const std::string text = p.text("waypoints");
  std::string_view rest = text;
  while (true) {
    const std::size_t end = std::min(rest.find(';'), rest.size());
    const auto numbers = parseNumbers(rest.substr(0, end));
    if (!numbers || numbers->size() != 2)
      p.fail("waypoints",
             "has \"" + std::string(rest.substr(0, end)) + "\", must be x,y;x,y;... in metres");
    points.push_back({(*numbers)[0], (*numbers)[1]});
    if (end == rest.size()) return points;
    rest.remove_prefix(end + 1);
  }
}

/// Returns the times at which the robot is kidnapped.
std::vector<Timestamp> kidnapsOption(const Parameters& p) {
  std::vector<Timestamp> moments;
  if (!p.has("kidnap")) return moments;
  const std::string text = p.text("kidnap");
  const auto numbers = parseNumbers(text);
  if (!numbers) p.fail("kidnap", "is \"" + text + "\", must be times in seconds, t,t,...");
  for (const double seconds : *numbers) {
    const bool isTime = seconds >= 0.0 && seconds <= 1e6;  // otherwise it does not fit a time stamp
    if (!isTime || (!moments.empty() && fromSeconds(seconds) <= moments.back()))
      p.fail("kidnap", "is \"" + text + "\", must be rising times in [0, 1e6] s");
    moments.push_back(fromSeconds(seconds));
  }
  return moments;
}

/// Reads the scene of the file, which itself says which robots drive where.
Scene readScene(const Parameters& p) {
  for (const char* key : {"start", "waypoints", "speed", "kidnap"})
    if (p.has(key)) p.fail(key, "does not fit a scene, which itself says where robots drive");
  p.textOr("robot_file", "");  // the scene names its own
  return Scene::read(p.text("path"));
}

/// Makes a scene of one robot in the world of the file, which wanders about or follows waypoints.
Scene sceneOfOne(const Parameters& p) {
  Scene scene;
  scene.world = p.text("path");
  SceneRobot robot;
  robot.file = p.textOr("robot_file", "");
  if (robot.file.empty())
    p.fail("robot_file", "is missing; the simulator needs a robot file, e.g. robots/pioneer.toml");
  robot.name = readRobot(robot.file).name;
  robot.start = optionPose(p, "start");
  robot.waypoints = waypointsOption(p);
  robot.wanders = robot.waypoints.empty();
  robot.speed = optionNumber(p, "speed", {0.0, 20.0});
  robot.kidnaps = kidnapsOption(p);
  scene.robots.push_back(robot);
  return scene;
}

}  // namespace

SimulatedRun SimulatedRun::read(const Parameters& p) {
  SimulatedRun run;
  const auto duration = optionNumber(p, "duration", {0.0, 1e6});
  if (const auto cycle = optionNumber(p, "cycle_ms", {0.1, 1000.0}))
    run.config.cycle = *cycle / 1000.0;
  run.config.seed = seedOption(p);
  run.config.noise = p.choiceOr("noise", "on", {"on", "off"}) == "on";
  run.hasPictures = p.choiceOr("pictures", "off", {"on", "off"}) == "on";
  const bool isScene = Scene::isScene(p.text("path"));
  run.scene = isScene ? readScene(p) : sceneOfOne(p);
  run.duration = fromSeconds(duration.value_or(run.scene.duration.value_or(kUsualDuration)));
  if (!run.scene.robots.empty()) run.robot = run.scene.robots.front().name;
  if (isScene) run.robot = p.textOr("robot", run.robot);
  return run;
}

}  // namespace ortung

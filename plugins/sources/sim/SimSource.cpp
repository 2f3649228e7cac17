#include <algorithm>
#include <charconv>
#include <optional>
#include <stdexcept>
#include <string_view>

#include "ortung/core/Plugin.hpp"
#include "ortung/core/PluginFactory.hpp"
#include "ortung/core/Source.hpp"
#include "ortung/core/SourceHelp.hpp"
#include "ortung/core/SourceOptions.hpp"
#include "ortung/robot/RobotFile.hpp"
#include "ortung/robot/TomlFile.hpp"
#include "ortung/sim/Scene.hpp"
#include "ortung/sim/SceneRun.hpp"

namespace ortung {
namespace {

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

/// Moments at which the robot is carried elsewhere.
std::vector<Timestamp> kidnapsOption(const Parameters& p) {
  std::vector<Timestamp> moments;
  if (!p.has("kidnap")) return moments;
  const std::string text = p.text("kidnap");
  const auto numbers = parseNumbers(text);
  if (!numbers) p.fail("kidnap", "is \"" + text + "\", must be times in seconds, t,t,...");
  for (const double seconds : *numbers) {
    const bool isTime = seconds >= 0.0 && seconds <= 1e6;  // or it is no time stamp either
    if (!isTime || (!moments.empty() && fromSeconds(seconds) <= moments.back()))
      p.fail("kidnap", "is \"" + text + "\", must be rising times in [0, 1e6] s");
    moments.push_back(fromSeconds(seconds));
  }
  return moments;
}

/// What a simulated run is: the options of the source's text.
struct Run {
  Timestamp duration;
  Simulation::Config simulation;

  static Run read(const Parameters& p) {
    Run run;
    run.duration = fromSeconds(optionNumber(p, "duration", 60.0, {0.0, 1e6}));
    if (const auto cycle = optionNumber(p, "cycle_ms", {0.1, 1000.0}))
      run.simulation.cycle = *cycle / 1000.0;
    run.simulation.seed = seedOption(p);
    run.simulation.noise = p.choiceOr("noise", "on", {"on", "off"}) == "on";
    return run;
  }
};

/// The scene of the file; who goes where it says itself.
Scene readScene(const Parameters& p) {
  for (const char* key : {"start", "waypoints", "speed", "kidnap"})
    if (p.has(key)) p.fail(key, "does not fit a scene, which says itself who goes where");
  p.textOr("robot_file", "");  // the scene names its own
  return Scene::read(p.text("path"));
}

/// A scene of one robot in the world of the file: it wanders about, or follows waypoints.
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

/// Source "sim": what one robot senses in a scripted scene, or alone in a world.
class SimSource : public Source {
 public:
  explicit SimSource(const Parameters& p)
      : options_(Run::read(p)),
        isScene_(Scene::isScene(p.text("path"))),
        scene_(isScene_ ? readScene(p) : sceneOfOne(p)),
        factory_(PluginFactory::standardFolders()),
        run_(scene_, options_.simulation, factory_),
        fingerprint_(run_.simulation().world().fingerprint()) {
    if (!p.has("duration") && scene_.duration) options_.duration = fromSeconds(*scene_.duration);
    const std::string first = scene_.robots.front().name;
    const std::string name = isScene_ ? p.textOr("robot", first) : first;
    const auto found = run_.find(name);
    if (!found) p.fail("robot", "is \"" + name + "\", which is not in the scene");
    robot_ = *found;
    for (const SceneRobot& robot : scene_.robots)
      if (robot.name == name) robotToml_ = readTomlText(robot.file);
  }
  ~SimSource() override = default;

  bool next(Message& message) override {
    while (sent_ == frame_.size()) {
      stopAtProblem();
      if (now() > options_.duration) return false;
      run_.step();
      frame_ = run_.simulation().readings(robot_);
      sent_ = 0;
    }
    message = frame_[sent_++];
    return true;
  }

  double progress() const override {
    const Timestamp duration = std::max(options_.duration, Timestamp{1});
    return std::min(toSeconds(now()) / toSeconds(duration), 1.0);
  }
  std::string worldFingerprint() const override { return fingerprint_; }
  std::string robotToml() const override { return robotToml_; }

 private:
  Timestamp now() const { return run_.simulation().now(); }
  /// Readings without what failed would look like those of another robot.
  void stopAtProblem() const {
    for (const auto& robot : run_.simulation().robots())
      if (!robot->problems().empty()) throw std::runtime_error(robot->problems().front());
  }

  Run options_;
  bool isScene_;
  Scene scene_;
  PluginFactory factory_;
  SceneRun run_;
  std::string fingerprint_;
  std::string robotToml_;
  std::size_t robot_ = 0;
  std::span<const Message> frame_;
  std::size_t sent_ = 0;
};

/// What `ortung import sim --help` tells.
class SimHelp : public SourceHelp {
 public:
  explicit SimHelp(const Parameters&)
      : SourceHelp("world or scene (needs --with-robot for a world)",
                   {{"duration", "s", "60, or the scene's", "time of the last readings"},
                    {"seed", "", "1", "of noise, start and way"},
                    {"cycle_ms", "ms", "the world's", "time between two steps of the simulation"},
                    {"noise", "", "on", "off: sensors and odometry are exact"},
                    {"start", "m, m, deg", "at random", "x,y,theta; not with a scene"},
                    {"waypoints", "m", "wanders about",
                     "x,y;x,y;...: goes straight from one to the next; not with a scene"},
                    {"speed", "m/s", "the drive's", "at most; 0: stands still; not with a scene"},
                    {"kidnap", "s", "never",
                     "t,t,...: when the robot is carried elsewhere; not with a scene"},
                    {"robot", "", "the first", "name of the robot, of a scene"}}) {}
};

}  // namespace
}  // namespace ortung

ORTUNG_PLUGINS("sim_source", ortung::provide<ortung::Source, ortung::SimSource>("sim"),
               ortung::provide<ortung::SourceHelp, ortung::SimHelp>("sim"));

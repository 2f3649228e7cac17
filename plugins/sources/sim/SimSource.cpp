#include <algorithm>
#include <charconv>
#include <optional>
#include <string_view>

#include "ortung/core/Plugin.hpp"
#include "ortung/core/PluginFactory.hpp"
#include "ortung/core/Source.hpp"
#include "ortung/core/SourceOptions.hpp"
#include "ortung/robot/RobotFile.hpp"
#include "ortung/robot/TomlFile.hpp"
#include "ortung/sim/RoutePlanner.hpp"
#include "ortung/sim/Scene.hpp"
#include "ortung/sim/Simulation.hpp"

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
    const bool isLater = moments.empty() || fromSeconds(seconds) > moments.back();
    if (!(seconds >= 0.0 && seconds <= 1e6 && isLater))
      p.fail("kidnap", "is \"" + text + "\", must be rising times in [0, 1e6] s");
    moments.push_back(fromSeconds(seconds));
  }
  return moments;
}

/// What a simulated run is: the options of the source's text.
struct Run {
  Timestamp duration;
  Simulation::Config simulation;
  std::optional<Pose2> start;
  std::vector<FloorPoint> waypoints;
  std::optional<double> speed;  ///< [m/s]
  std::vector<Timestamp> kidnaps;

  static Run read(const Parameters& p) {
    Run run;
    run.duration = fromSeconds(optionNumber(p, "duration", 60.0, {0.0, 1e6}));
    if (const auto cycle = optionNumber(p, "cycle_ms", {0.1, 1000.0}))
      run.simulation.cycle = *cycle / 1000.0;
    run.simulation.seed = seedOption(p);
    run.simulation.noise = p.choiceOr("noise", "on", {"on", "off"}) == "on";
    run.start = optionPose(p, "start");
    run.waypoints = waypointsOption(p);
    run.speed = optionNumber(p, "speed", {0.0, 20.0});
    run.kidnaps = kidnapsOption(p);
    return run;
  }
};

std::filesystem::path robotFileOf(const Parameters& p) {
  const std::string file = p.textOr("robot_file", "");
  if (file.empty())
    p.fail("robot_file", "is missing; the simulator needs a robot file, e.g. robots/pioneer.toml");
  return file;
}

double shareOf(Timestamp now, Timestamp duration) {
  return std::min(toSeconds(now) / toSeconds(std::max(duration, Timestamp{1})), 1.0);
}

/// One robot that drives about a simulated world.
class RobotSource : public Source {
 public:
  explicit RobotSource(const Parameters& p)
      : worldFile_(p.text("path")),
        robotFile_(robotFileOf(p)),
        run_(Run::read(p)),
        factory_(PluginFactory::standardFolders()),
        simulation_(readWorld(worldFile_), run_.simulation),
        robotToml_(readTomlText(robotFile_)),
        config_(readRobot(parseToml(robotToml_, robotFile_.string()))),
        planner_(simulation_.world(), sizeOf(config_)),
        placing_(simulation_.random(kPlacing)),
        robot_(&enter()) {
    DriveLimits limits = robot_->drive().limits();
    if (run_.speed) limits.speed = std::min(limits.speed, *run_.speed);
    robot_->setDriver(run_.waypoints.empty()
                          ? makeWanderer(planner_, limits, simulation_.random(kWandering))
                          : makeFollower(run_.waypoints, limits));
  }
  ~RobotSource() override = default;

  bool next(Message& message) override {
    while (sent_ == frame_.size()) {
      if (simulation_.now() > run_.duration) return false;
      kidnap();
      simulation_.step();
      frame_ = simulation_.readings(0);
      sent_ = 0;
    }
    message = frame_[sent_++];
    return true;
  }

  double progress() const override { return shareOf(simulation_.now(), run_.duration); }
  std::string worldFingerprint() const override { return simulation_.world().fingerprint(); }
  std::string robotToml() const override { return robotToml_; }

 private:
  static constexpr std::uint64_t kPlacing = 0;
  static constexpr std::uint64_t kWandering = 1;
  static constexpr int kAttempts = 200;  ///< to find room beside what is movable

  SimRobot& enter() {
    for (int attempt = 1;; ++attempt) {
      const Pose2 start = run_.start ? *run_.start : planner_.randomPose(placing_);
      try {
        return simulation_.addRobot(config_, factory_, start);
      } catch (const std::invalid_argument&) {
        if (run_.start || attempt == kAttempts) throw;
      }
    }
  }

  void kidnap() {
    if (kidnapped_ == run_.kidnaps.size() || simulation_.now() < run_.kidnaps[kidnapped_]) return;
    ++kidnapped_;
    for (int attempt = 1;; ++attempt) {
      try {
        return simulation_.place(*robot_, planner_.randomPose(placing_));
      } catch (const std::invalid_argument&) {
        if (attempt == kAttempts) throw;
      }
    }
  }

  std::filesystem::path worldFile_;
  std::filesystem::path robotFile_;
  Run run_;
  PluginFactory factory_;
  Simulation simulation_;
  std::string robotToml_;
  RobotConfig config_;
  RoutePlanner planner_;
  Random placing_;
  SimRobot* robot_;  ///< the simulation's
  std::span<const Message> frame_;
  std::size_t sent_ = 0;
  std::size_t kidnapped_ = 0;
};

/// What one robot of a scripted scene senses.
class SceneSource : public Source {
 public:
  explicit SceneSource(const Parameters& p)
      : scene_(Scene::read(p.text("path"))),
        run_(Run::read(p)),
        factory_(PluginFactory::standardFolders()),
        player_(scene_, run_.simulation, factory_) {
    p.textOr("robot_file", "");  // the scene names its own
    for (const char* key : {"start", "waypoints", "speed", "kidnap"})
      if (p.has(key)) p.fail(key, "does not fit a scene, which says itself who goes where");
    if (!p.has("duration") && scene_.duration) run_.duration = fromSeconds(*scene_.duration);
    const std::string name = p.textOr("robot", scene_.robots.front().name);
    const auto found = player_.find(name);
    if (!found) p.fail("robot", "is \"" + name + "\", which is not in the scene");
    robot_ = *found;
    for (const SceneRobot& robot : scene_.robots)
      if (robot.name == name) file_ = robot.file;
  }
  ~SceneSource() override = default;

  bool next(Message& message) override {
    while (sent_ == frame_.size()) {
      if (player_.simulation().now() > run_.duration) return false;
      player_.step();
      frame_ = player_.simulation().readings(robot_);
      sent_ = 0;
    }
    message = frame_[sent_++];
    return true;
  }

  double progress() const override { return shareOf(now(), run_.duration); }
  std::string worldFingerprint() const override { return fingerprint_; }
  std::string robotToml() const override { return readTomlText(file_); }

 private:
  Timestamp now() const { return player_.simulation().now(); }

  Scene scene_;
  Run run_;
  PluginFactory factory_;
  ScenePlayer player_;
  std::string fingerprint_ = player_.simulation().world().fingerprint();
  std::filesystem::path file_;
  std::size_t robot_ = 0;
  std::span<const Message> frame_;
  std::size_t sent_ = 0;
};

/// Source "sim": a world with one robot, or a scene.
class SimSource : public Source {
 public:
  explicit SimSource(const Parameters& p) {
    if (Scene::isScene(p.text("path")))
      source_ = std::make_unique<SceneSource>(p);
    else
      source_ = std::make_unique<RobotSource>(p);
  }
  ~SimSource() override = default;
  bool next(Message& message) override { return source_->next(message); }
  double progress() const override { return source_->progress(); }
  std::string worldFingerprint() const override { return source_->worldFingerprint(); }
  std::string robotToml() const override { return source_->robotToml(); }

 private:
  std::unique_ptr<Source> source_;
};

}  // namespace
}  // namespace ortung

ORTUNG_PLUGINS("sim_source", ortung::provide<ortung::Source, ortung::SimSource>("sim"));

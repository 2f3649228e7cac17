#include "Localization.hpp"

#include <fmt/format.h>

#include <chrono>
#include <stdexcept>
#include <utility>

#include "Console.hpp"
#include "Interrupt.hpp"
#include "Numbers.hpp"
#include "ortung/robot/TomlFile.hpp"

namespace ortung::app {
namespace {

MclConfig readMcl(const LocalizationArguments& arguments, const RobotConfig& robot) {
  MclConfig config = MclConfig::read(robot.mcl);
  config.seed = arguments.seed;
  if (arguments.threads) config.threads = *arguments.threads;
  if (arguments.particles) {
    config.maxSamples = *arguments.particles;
    if (config.minSamples > config.maxSamples) config.minSamples = config.maxSamples;
  }
  config.check();
  return config;
}

/// Four numbers of --motion in place of those of the robot file.
Parameters withNumbers(const std::string& text, const Parameters& robotFile) {
  const std::vector<std::string> names = {"turn_per_turn", "turn_per_m", "way_per_m",
                                          "way_per_turn"};
  const std::vector<double> numbers = parseNumbers(text, "--motion", names);
  Parameters motion("--motion");
  for (const char* key : {"floor_m", "floor_deg"}) {
    if (robotFile.has(key)) motion.set(key, robotFile.number(key));
  }
  if (robotFile.has("plugin")) motion.set("plugin", robotFile.text("plugin"));
  for (std::size_t i = 0; i < names.size(); ++i) motion.set(names[i], numbers[i]);
  return motion;
}

std::unique_ptr<MotionModel> readMotion(const LocalizationArguments& arguments, Robot& robot) {
  const std::string& text = arguments.motion;
  if (text.empty()) return makeMotion(robot.config.motion, robot.factory);
  if (text.find_first_not_of("0123456789+-.eE,") != std::string::npos) {
    return makeMotion(readMotionFile(text), robot.factory);
  }
  const Parameters motion = withNumbers(text, robot.config.motion);
  try {
    return makeMotion(motion, robot.factory);
  } catch (const ConfigError& error) {
    throw UsageError(error.what());
  }
}

double millisecondsSince(std::chrono::steady_clock::time_point begin) {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin)
      .count();
}

}  // namespace

std::unique_ptr<MotionModel> makeMotion(const Parameters& motion, PluginFactory& factory) {
  return factory.make<MotionModel>(motion.textOr("plugin", "odometry"), motion);
}

Parameters readMotionFile(const std::filesystem::path& file) {
  const Parameters parameters = readToml(file);
  if (!parameters.has("motion")) {
    throw ConfigError(file.string() +
                      ": has no table [motion], expected one as in a robot file or as "
                      "`ortung learn-motion` writes it");
  }
  return parameters.table("motion");
}

std::unique_ptr<Robot> openRobot(const std::filesystem::path& robotFile) {
  auto robot = std::make_unique<Robot>();
  robot->config = readRobot(robotFile);
  robot->devices = fillContainer(robot->container, robot->config, robot->factory);
  return robot;
}

std::unique_ptr<Robot> openRobot(const std::filesystem::path& robotFile,
                                 const std::filesystem::path& tablesFile) {
  std::unique_ptr<Robot> robot = openRobot(robotFile);
  robot->tables = loadTables(std::make_shared<const TableFile>(tablesFile), robot->container);
  return robot;
}

void checkWorld(const std::string& sourceName, const Source& source,
                const std::filesystem::path& tablesFile, const TableInfo& tables, bool anyWorld) {
  const std::string world = source.worldFingerprint();
  if (world.empty() || tables.worldFingerprint.empty() || world == tables.worldFingerprint) return;
  const std::string what =
      fmt::format("{}: comes from the world {}, but {} was learned in the world {} ('{}')",
                  sourceName, world, tablesFile.string(), tables.worldFingerprint, tables.world);
  if (!anyWorld) {
    throw std::runtime_error(what + "; learn the tables in the same world, or use --any-world");
  }
  warn(what);
}

Localization::Start Localization::Start::read(const LocalizationArguments& arguments) {
  const std::vector<double> sigmas =
      parseNumbers(arguments.startSigma, "--start-sigma", {"m", "deg"});
  if (sigmas[0] < 0.0 || sigmas[1] < 0.0) {
    throw UsageError("--start-sigma is '" + arguments.startSigma + "', expected numbers >= 0");
  }
  Start start{Kind::kGlobal, {}, sigmas[0], radians(sigmas[1])};
  if (arguments.start == "truth") start.kind = Kind::kTruth;
  if (arguments.start == "global" || arguments.start == "truth") return start;
  const std::vector<double> pose =
      parseNumbers(arguments.start, "--start", {"x", "y", "theta_deg"});
  start.kind = Kind::kPose;
  start.pose = {pose[0], pose[1], wrapAngle(radians(pose[2]))};
  return start;
}

Localization::Localization(const LocalizationArguments& arguments)
    : sourceName_(arguments.source),
      start_(Start::read(arguments)),
      robot_(openRobot(arguments.robot, arguments.tables)),
      source_(openSource(arguments.source, arguments.robot, robot_->factory)),
      feeder_(std::make_unique<Feeder>(arguments.source, *source_, robot_->container)),
      config_(readMcl(arguments, robot_->config)),
      mcl_(std::make_unique<Mcl>(config_, robot_->tables.region, readMotion(arguments, *robot_))),
      waitsForTruth_(start_.kind == Start::Kind::kTruth) {
  checkWorld(arguments.source, *source_, arguments.tables, robot_->tables, arguments.anyWorld);
  if (start_.kind == Start::Kind::kGlobal) mcl_->startGlobal();
  if (start_.kind == Start::Kind::kPose) {
    mcl_->startAt(start_.pose, start_.sigmaPosition, start_.sigmaHeading);
  }
}

Localization::~Localization() = default;

bool Localization::isStarted() {
  if (!waitsForTruth_) return true;
  if (!feeder_->truth()) return false;
  mcl_->startAt(*feeder_->truth(), start_.sigmaPosition, start_.sigmaHeading);
  waitsForTruth_ = false;
  return true;
}

std::optional<EvaluationStep> Localization::next() {
  while (feeder_->next()) {
    checkInterrupt();
    if (listener_) listener_(*feeder_);
    if (!isStarted()) continue;
    const auto begin = std::chrono::steady_clock::now();
    const bool weighed = mcl_->update(robot_->container);
    milliseconds_ += millisecondsSince(begin);
    if (weighed) return EvaluationStep{mcl_->estimate(), std::exchange(milliseconds_, 0.0)};
  }
  if (waitsForTruth_) {
    throw std::runtime_error(sourceName_ +
                             ": has no ground truth to start from, expected a feature of type "
                             "groundTruth; use --start global or --start x,y,theta_deg");
  }
  return std::nullopt;
}

}  // namespace ortung::app

#include "Localizing.hpp"

#include <fmt/format.h>

#include <stdexcept>
#include <utility>
#include <vector>

#include "Console.hpp"
#include "Interrupt.hpp"
#include "Numbers.hpp"
#include "SourceArguments.hpp"
#include "ortung/base/Angles.hpp"

namespace ortung::app {
namespace {

LocalizationStart readStart(const LocalizationArguments& arguments) {
  using Kind = LocalizationStart::Kind;
  const std::vector<double> sigmas =
      parseNumbers(arguments.startSigma, "--start-sigma", {"m", "deg"});
  if (sigmas[0] < 0.0 || sigmas[1] < 0.0) {
    throw UsageError("--start-sigma is '" + arguments.startSigma + "', expected numbers >= 0");
  }
  LocalizationStart start{Kind::kGlobal, {}, sigmas[0], radians(sigmas[1])};
  if (arguments.start == "truth") start.kind = Kind::kTruth;
  if (arguments.start == "global" || arguments.start == "truth") return start;
  const std::vector<double> pose =
      parseNumbers(arguments.start, "--start", {"x", "y", "theta_deg"});
  start.kind = Kind::kPose;
  start.pose = {pose[0], pose[1], wrapAngle(radians(pose[2]))};
  return start;
}

/// Returns the robot file's settings with the four numbers of --motion.
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

std::optional<Parameters> readMotion(const LocalizationArguments& arguments, Robot& robot) {
  const std::string& text = arguments.motion;
  if (text.empty()) return std::nullopt;
  if (text.find_first_not_of("0123456789+-.eE,") != std::string::npos) return readMotionFile(text);
  const Parameters motion = withNumbers(text, robot.config.motion);
  try {
    makeMotion(motion, robot.factory);  // so that errors name the command line
  } catch (const ConfigError& error) {
    throw UsageError(error.what());
  }
  return motion;
}

GridConfig readGrid(const LocalizationArguments& arguments) {
  const std::vector<double> numbers =
      parseNumbers(arguments.grid, "--grid", {"cell_m", "step_deg"});
  GridConfig grid;
  grid.cell = numbers[0];
  grid.headingStep = radians(numbers[1]);
  try {
    grid.check();
  } catch (const std::invalid_argument& error) {
    throw UsageError(std::string("--grid: ") + error.what());
  }
  return grid;
}

}  // namespace

std::unique_ptr<Localization> openLocalization(
    const LocalizationArguments& arguments, bool warns,
    const std::function<std::unique_ptr<Source>(Robot&)>& makeSource) {
  LocalizationConfig config;
  config.start = readStart(arguments);
  config.robot = arguments.robot;
  config.tables = arguments.tables;
  config.source = arguments.source;
  config.seed = arguments.seed;
  config.particles = arguments.particles;
  config.threads = arguments.threads;
  config.publish = arguments.publish;
  config.grid = readGrid(arguments);
  if (arguments.besideGrid) config.filter = LocalizationFilter::kMclBesideGrid;
  if (arguments.filter == "grid") config.filter = LocalizationFilter::kGrid;
  config.anyWorld = true;  // the message below names the option
  std::unique_ptr<Robot> robot = openRobot(arguments.robot, arguments.tables);
  std::unique_ptr<Source> source =
      makeSource ? makeSource(*robot)
                 : openSourceArgument(arguments.source, arguments.robot, robot->factory);
  config.motion = readMotion(arguments, *robot);
  auto localization = std::make_unique<Localization>(std::move(robot), std::move(source), config);
  const std::string& mismatch = localization->worldMismatch();
  if (mismatch.empty()) return localization;
  if (!arguments.anyWorld) {
    throw std::runtime_error(mismatch + "; learn the tables in the same world, or use --any-world");
  }
  if (warns) warn(mismatch);
  return localization;
}

void declareInputs(const LocalizationArguments& arguments, Outputs& outputs) {
  outputs.reads(arguments.robot);
  outputs.reads(arguments.tables);
  outputs.readsSource(arguments.source);
  outputs.reads(arguments.motion);
}

std::optional<EvaluationStep> nextStep(Localization& localization,
                                       const LocalizationArguments& arguments,
                                       const std::function<void(const Feeder&)>& onMoment) {
  while (unlessInterrupted(localization.source(), [&] { return localization.advance(); })) {
    if (onMoment) onMoment(localization.feeder());
    if (const std::optional<PoseEstimate> estimate = localization.update())
      return EvaluationStep{*estimate, localization.updateMilliseconds(),
                            localization.spentMilliseconds()};
  }
  if (!localization.isStarted()) {
    throw std::runtime_error(arguments.source +
                             ": has no ground truth to start from, expected a feature of type "
                             "groundTruth; use --start global or --start x,y,theta_deg");
  }
  return std::nullopt;
}

void requireUpdates(std::size_t updates, const LocalizationArguments& arguments) {
  if (updates > 0) return;
  throw std::runtime_error(arguments.source +
                           ": has no reading that depends on the pose, of a feature that "
                           "was learned, so there is nothing to localize with");
}

bool warnWithoutOdometry(const Localization& localization, const LocalizationArguments& arguments) {
  if (localization.hasOdometry()) return false;
  const MclConfig& mcl = localization.mclConfig();
  warn(
      fmt::format("{}: has no odometry (a feature of the robot file, with plugin "
                  "'odometry'); MCL assumes random motion of {:.3g} m and {:.3g} degrees in "
                  "a second ([mcl] drift_m, drift_deg)",
                  arguments.source, mcl.driftMetres, degrees(mcl.driftRadians)));
  return true;
}

}  // namespace ortung::app

#include "TrainMotion.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "Console.hpp"
#include "Interrupt.hpp"
#include "MotionGrid.hpp"
#include "MotionLogs.hpp"
#include "NetworkTrainer.hpp"
#include "Numbers.hpp"
#include "Outputs.hpp"
#include "Progress.hpp"
#include "ortung/base/Angles.hpp"
#include "ortung/robot/MotionNetworkFile.hpp"
#include "ortung/run/Robot.hpp"
#include "ortung/sim_api/Drive.hpp"

namespace ortung::app {
namespace {

constexpr std::size_t kWindow = 20;    // greatest number of steps before the first prediction
constexpr int kDriveCyclesAStep = 10;  // cycles of the analytic model in a time step
constexpr std::size_t kFewestExamples = 100;

struct Grids {
  std::vector<MotionGrid> train;
  std::vector<MotionGrid> heldOut;
};

Grids readGrids(const TrainMotionArguments& arguments, bool& fromVelocities) {
  Progress progress("reading", arguments.progress);
  Grids grids;
  const double border = 1.0 - arguments.holdOut;
  for (const std::string& source : arguments.sources) {
    const CommandLog log =
        readCommandLog(source, arguments.robot, arguments.commandsFrom, fromVelocities, progress);
    for (auto& grid : gridsOf(log, arguments.step, 0.0, border))
      grids.train.push_back(std::move(grid));
    for (auto& grid : gridsOf(log, arguments.step, border, 1.0))
      grids.heldOut.push_back(std::move(grid));
  }
  return grids;
}

std::vector<std::size_t> hiddenOf(const std::string& text) {
  std::vector<std::string> names(
      1 + static_cast<std::size_t>(std::count(text.begin(), text.end(), ',')), "width");
  std::vector<std::size_t> widths;
  for (const double width : parseNumbers(text, "--hidden", names)) {
    if (!(width >= 1 && width <= 256) || width != std::floor(width) || names.size() > 6) {
      throw UsageError("--hidden is '" + text +
                       "', expected up to 6 widths from 1 to 256, e.g. 24,24");
    }
    widths.push_back(static_cast<std::size_t>(width));
  }
  return widths;
}

void train(MotionNetwork& network, const std::vector<MotionExample>& examples,
           const std::vector<MotionExample>& heldOut, const TrainMotionArguments& arguments) {
  TrainingOptions options;
  options.hidden = hiddenOf(arguments.hidden);
  options.iterations = arguments.iterations;
  options.seed = arguments.seed;
  fmt::print(
      "{} examples, {} held out; {:g} s a step, {} commands, layers {}\n"
      "iteration  loss      held out\n",
      examples.size(), heldOut.size(), network.step, network.commands, arguments.hidden);
  trainNetwork(network, examples, heldOut, options, [](const TrainingState& state) {
    fmt::print("{:9}  {:.6f}  {:.6f}\n", state.iteration, state.loss, state.heldOutLoss);
    return interruptSignal() == 0;
  });
  checkInterrupt();
}

Pose2 byNetwork(const MotionNetwork& network, const MotionGrid& grid, std::size_t at,
                std::size_t steps) {
  NeuralRobot robot(network);
  for (std::size_t i = network.commands - 1; i > 0; --i) robot.step(grid.command[at - i]);
  robot.setVelocity(grid.velocity[at]);
  Pose2 pose;
  for (std::size_t i = 0; i < steps; ++i) pose = pose * robot.step(grid.command[at + i]);
  return pose;
}

Pose2 along(const Velocities& velocity, double seconds) {
  const double turn = velocity.rotational * seconds;
  const double half = turn / 2.0;
  const double chord =
      velocity.translational * seconds * (std::abs(half) < 1e-6 ? 1.0 : std::sin(half) / half);
  return {chord * std::cos(half), chord * std::sin(half), turn};
}

Pose2 byCommands(double step, const MotionGrid& grid, std::size_t at, std::size_t steps) {
  Pose2 pose;
  for (std::size_t i = 0; i < steps; ++i) pose = pose * along(grid.command[at + i], step);
  return pose;
}

Pose2 byDrive(Drive& drive, double step, const MotionGrid& grid, std::size_t at,
              std::size_t steps) {
  const Velocities& now = grid.velocity[at];
  drive.setVelocity({now.translational, 0.0, now.rotational});
  Pose2 pose;
  for (std::size_t i = 0; i < steps; ++i) {
    drive.setTranslationalVelocity(grid.command[at + i].translational);
    drive.setRotationalVelocity(grid.command[at + i].rotational);
    for (int k = 0; k < kDriveCyclesAStep; ++k)
      pose = pose * drive.relocate(step / kDriveCyclesAStep, nullptr);
  }
  return pose;
}

void printErrors(const char* name, const PredictionErrors& e) {
  fmt::print("  {:<18} {:8.4f} {:8.4f} {:8.2f} {:8.2f}\n", name, e.positionMedian, e.positionRmse,
             degrees(e.headingMedian), degrees(e.headingRmse));
}

/// Compares the network with models that are not learned, on the part that was held out.
void compare(const MotionNetwork& network, const std::vector<MotionGrid>& grids, Robot& robot) {
  const auto steps = static_cast<std::size_t>(std::max(1L, std::lround(1.0 / network.step)));
  const std::size_t before = std::max(network.commands, kWindow);
  const auto errors = [&](const Predictor& predict) {
    return errorsOf(predict, grids, steps, before, network.limit);
  };
  const std::string plugin = robot.config.drive.textOr("plugin", "differential");
  robot.config.drive.numberOr("body_height_m", 0.5);
  const auto drive =
      robot.factory.make<Drive>(plugin == "neural" ? "differential" : plugin,
                                plugin == "neural" ? Parameters("drive") : robot.config.drive);
  const PredictionErrors ours = errors([&](const MotionGrid& grid, std::size_t at, std::size_t n) {
    return byNetwork(network, grid, at, n);
  });
  fmt::print(
      "predictions over {:g} s, {} of the part held out:\n"
      "                     position [m]      heading [deg]\n"
      "                       median     RMSE   median     RMSE\n",
      static_cast<double>(steps) * network.step, ours.count);
  printErrors("network", ours);
  printErrors("analytic model", errors([&](const MotionGrid& grid, std::size_t at, std::size_t n) {
                return byDrive(*drive, network.step, grid, at, n);
              }));
  printErrors("commands", errors([&](const MotionGrid& grid, std::size_t at, std::size_t n) {
                return byCommands(network.step, grid, at, n);
              }));
  printErrors("constant velocity",
              errors([&](const MotionGrid& grid, std::size_t at, std::size_t n) {
                return along(grid.velocity[at], static_cast<double>(n) * network.step);
              }));
}

}  // namespace

int runTrainMotion(const TrainMotionArguments& arguments) {
  Outputs outputs(arguments.force);
  for (const std::string& source : arguments.sources) outputs.readsSource(source);
  outputs.reads(arguments.robot);
  outputs.writes("--out", arguments.out, OutputKind::kNetwork);
  hiddenOf(arguments.hidden);
  MotionNetwork network;
  network.step = arguments.step;
  network.commands = arguments.commands;
  const Grids grids = readGrids(arguments, network.fromVelocities);
  network.limit = limitOf(grids.train);
  const std::vector<MotionExample> examples = examplesOf(network, grids.train);
  if (examples.size() < kFewestExamples) {
    throw std::runtime_error(
        fmt::format("found {} steps with commands and ground truth to train from, "
                    "expected at least {}",
                    examples.size(), kFewestExamples));
  }
  train(network, examples, examplesOf(network, grids.heldOut), arguments);
  outputs.write(arguments.out, toJson(network));
  const std::unique_ptr<Robot> robot = openRobot(arguments.robot);
  if (!grids.heldOut.empty()) compare(network, grids.heldOut, *robot);
  return 0;
}

}  // namespace ortung::app

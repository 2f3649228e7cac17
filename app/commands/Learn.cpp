#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "Commands.hpp"
#include "Console.hpp"
#include "Interrupt.hpp"
#include "Numbers.hpp"
#include "Outputs.hpp"
#include "Progress.hpp"
#include "ortung/base/Angles.hpp"
#include "ortung/robot/TableInfo.hpp"
#include "ortung/robot/TomlFile.hpp"
#include "ortung/run/Robot.hpp"
#include "ortung/sim/Learner.hpp"
#include "ortung/sim/RobotShape.hpp"

namespace ortung::app {
namespace {

/// The step in radians. @throws UsageError unless it divides a turn
double headingStep(double stepDeg) {
  const double steps = 360.0 / stepDeg;
  if (std::abs(steps - std::round(steps)) > 1e-6) {
    throw UsageError(
        fmt::format("--heading-step is {}, expected degrees that divide a turn, "
                    "e.g. 1, 2 or 2.5",
                    stepDeg));
  }
  return kTurn / std::round(steps);
}

/// Where the robot can stand, of the part of the floor that is asked for.
FieldRegion readArea(const LearnArguments& arguments, const SimWorld& world,
                     const RobotSize& robot) {
  if (arguments.area == "all") {
    FieldRegion all = world.region(arguments.cell, robot);
    all.check();
    return all;
  }
  std::optional<std::array<double, 2>> inside;
  if (arguments.area != "auto") {
    const std::vector<double> point = parseNumbers(arguments.area, "--area", {"x", "y"});
    inside = {point[0], point[1]};
  }
  LearnArea area = learnArea(world, arguments.cell, robot, inside);
  if (area.leftOut > 0.0)
    note(fmt::format("{}: {:.1f} m^2 that walls part from where the robot is are left out (--area)",
                     arguments.world.string(), area.leftOut));
  return std::move(area.region);
}

/// How the table's features are called in the file.
TableInfo describe(const SimWorld& world, const Robot& robot, const FieldRegion& region,
                   double step, const std::string& robotToml) {
  TableInfo info;
  info.world = world.name();
  info.worldFingerprint = world.fingerprint();
  info.robot = robot.config.name;
  info.headingStep = step;
  info.region = region;
  info.field = fieldModelOf(world);
  info.robotToml = robotToml;
  return info;
}

std::size_t countOf(const std::vector<std::uint8_t>& mask) {
  return static_cast<std::size_t>(
      std::count_if(mask.begin(), mask.end(), [](auto m) { return m != 0; }));
}

std::size_t learnedFeatures(const SensorContainer& container) {
  const auto all = container.all();
  return static_cast<std::size_t>(std::count_if(all.begin(), all.end(), [](const auto& data) {
    return data->localizes() && data->isLearned();
  }));
}

}  // namespace

int runLearn(const LearnArguments& arguments) {
  const auto begin = std::chrono::steady_clock::now();
  const double step = headingStep(arguments.headingStepDeg);
  Outputs outputs(arguments.force);
  outputs.reads(arguments.world);
  outputs.reads(arguments.robot);
  outputs.writes("--out", arguments.out, OutputKind::kTables);
  const std::unique_ptr<SimWorld> world = readWorld(arguments.world);
  const std::unique_ptr<Robot> robot = openRobot(arguments.robot);
  const FieldRegion region = readArea(arguments, *world, sizeOf(robot->config));
  {
    Progress progress("learning", arguments.progress);
    learn(*world, region, robot->devices, robot->factory, {arguments.cell, step},
          [&](double share) {
            progress.update(share);
            return interruptSignal() == 0;
          });
  }
  checkInterrupt();
  const std::uintmax_t bytes =
      writeTables(outputs.ready(arguments.out), robot->container,
                  describe(*world, *robot, region, step, readTomlText(arguments.robot)));
  if (learnedFeatures(robot->container) == 0)
    warn(arguments.robot.string() +
         ": has no feature that localizes, so there was nothing to learn");
  const double seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  fmt::print(
      "{}: {} features of {} in {} ({}), {} x {} cells of {:g} m, {} open, {} standable, "
      "{:.1f} MB, {:.2f} s\n",
      arguments.out.string(), learnedFeatures(robot->container), robot->config.name, world->name(),
      world->fingerprint(), region.grid.columns, region.grid.rows, region.grid.cell,
      countOf(region.open), countOf(region.standable), static_cast<double>(bytes) / 1e6, seconds);
  return 0;
}

}  // namespace ortung::app

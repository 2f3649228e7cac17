#include "CommandModule.hpp"
#include "Learn.hpp"
#include "OptionBuilder.hpp"
#include "RobotSettings.hpp"

namespace ortung::app {
namespace {

void addLearn(Builder& build) {
  const auto a = build.command<LearnArguments>(
      "learn",
      "ortung learn --world maps/fields/f2000.toml --robot maps/robots/pioneer.toml --out "
      "f2000.ortung",
      runLearn);
  build.option("--world", a->world, "World file (TOML)").required();
  build.option("--robot", a->robot, "Robot file (TOML)").required();
  build.option("--out", a->out, "Table file to write").required();
  build.option("--cell", a->cell, "Edge of a cell [m]").within(0.01, 10.0).showsDefault();
  build
      .option("--heading-step", a->headingStepDeg,
              "Resolution of directions [degrees]; divides a turn")
      .within(0.1, 90.0)
      .showsDefault();
  build
      .option("--area", a->area,
              "Part of the floor on which the robot is: 'auto' (the largest one, except what is "
              "outside "
              "walls), 'x,y' (the one with that point [m]) or 'all'")
      .showsDefault();
  build.option("--threads", a->threads, "Threads; what is learned does not depend on it")
      .within(1, 256)
      .showsDefault();
  addSettings(build, a->settings);
  build.shard(a->shard, a->job);
  build.flag("--force", a->force, kForce);
  build.flag("--progress", a->progress, kProgress);
}

}  // namespace
}  // namespace ortung::app

ORTUNG_COMMAND_MODULE(ortung::app::addLearn)

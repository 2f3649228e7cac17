#include "CommandModule.hpp"
#include "LearnMotion.hpp"
#include "OptionBuilder.hpp"

namespace ortung::app {
namespace {

void addLearnMotion(Builder& build) {
  const auto a = build.command<LearnMotionArguments>(
      "learn-motion", "ortung learn-motion run1.rec run2.rec --robot robot.toml --out motion.toml",
      runLearnMotion);
  build.option("sources", a->sources, "Records, or sources KIND:PATH?key=value").required();
  build.option("--robot", a->robot, "Robot file (TOML)").required();
  build
      .option("--out", a->out,
              "File to write, with the table [motion] for a robot file or eval --motion")
      .required();
  build
      .option(
          "--plugin", a->plugin,
          "Motion model to learn (default: that of the robot file); `ortung plugins` lists them")
      .showsDefault();
  build.option("--motion", a->motion,
               "File with [motion] to begin with, e.g. with a network; in place of --plugin");
  build.option("--interval", a->interval, "Length of the shortest pieces of motion [s]")
      .within(0.05, 60.0)
      .showsDefault();
  build.option("--from", a->from, "Begin of the part to learn from, as a share of each log's time")
      .within(0.0, 1.0)
      .showsDefault();
  build.option("--to", a->to, "End of the part to learn from, as a share of each log's time")
      .within(0.0, 1.0)
      .showsDefault();
  build.option("--delay", a->delay, "How far odometry is ahead of the robot [s]; default: learned")
      .within(-0.3, 2.0);
  build.flag("--force", a->force, kForce);
  build.flag("--progress", a->progress, kProgress);
}

}  // namespace
}  // namespace ortung::app

ORTUNG_COMMAND_MODULE(ortung::app::addLearnMotion)

#include "CommandModule.hpp"
#include "OptionBuilder.hpp"
#include "TrainMotion.hpp"

namespace ortung::app {
namespace {

void addTrainMotion(Builder& build) {
  const auto a = build.command<TrainMotionArguments>(
      "train-motion", "ortung train-motion run.rec --robot robot.toml --out motion.json",
      runTrainMotion);
  build.option("sources", a->sources, "Records, or sources KIND:PATH?key=value, with ground truth")
      .required();
  build.option("--robot", a->robot, "Robot file (TOML)").required();
  build.option("--out", a->out, "Network to write (JSON)").required();
  build
      .option("--commands-from", a->commandsFrom,
              "Where odometry has the commanded velocities: velocities, motion_data (its last two "
              "words), or auto: motion_data if there is some")
      .oneOf({"auto", "velocities", "motion_data"})
      .showsDefault();
  build.option("--step", a->step, "Time that a prediction covers [s]")
      .within(0.01, 1.0)
      .showsDefault();
  build.option("--commands", a->commands, "How many of the newest commands the network sees")
      .within(1, 64)
      .showsDefault();
  build.option("--hidden", a->hidden, "Widths of the hidden layers").showsDefault();
  build.option("--iterations", a->iterations, "Steps of the training")
      .within(1, 100000)
      .showsDefault();
  build.option("--hold-out", a->holdOut, "Share of each log, at its end, for the test")
      .within(0.0, 0.9)
      .showsDefault();
  build.option("--seed", a->seed, "Seed of the first weights").showsDefault();
  build.flag("--force", a->force, kForce);
  build.flag("--progress", a->progress, kProgress);
}

}  // namespace
}  // namespace ortung::app

ORTUNG_COMMAND_MODULE(ortung::app::addTrainMotion)

#include "LearnCommands.hpp"

#include "Commands.hpp"
#include "OptionBuilder.hpp"

namespace ortung::app {

void addLearn(Builder& build, CLI::App& app) {
  const auto a = build.command<LearnArguments>(
      app, "learn", "Learn what a robot's sensors read all over a world",
      "ortung learn --world maps/fields/f2000.toml --robot maps/robots/pioneer.toml --out "
      "f2000.ortung",
      runLearn);
  build.option("--world", a->world, "World file (TOML)")->required();
  build.option("--robot", a->robot, "Robot file (TOML)")->required();
  build.option("--out", a->out, "Table file to write")->required();
  build.option("--cell", a->cell, "Edge of a cell [m]")
      ->check(within(0.01, 10.0))
      ->capture_default_str();
  build
      .option("--heading-step", a->headingStepDeg,
              "Resolution of directions [degrees]; divides a turn")
      ->check(within(0.1, 90.0))
      ->capture_default_str();
  build
      .option("--area", a->area,
              "Part of the floor on which the robot is: 'auto' (the largest, but what walls leave "
              "outside), 'x,y' (where that point is [m]) or 'all'")
      ->capture_default_str();
  build.option("--threads", a->threads, "Threads; what is learned does not depend on it")
      ->check(within(1, 256))
      ->capture_default_str();
  build.flag("--force", a->force, kForce);
  build.flag("--progress", a->progress, kProgress);
}

void addLearnMotion(Builder& build, CLI::App& app) {
  const auto a = build.command<LearnMotionArguments>(
      app, "learn-motion", "Learn from logs with ground truth what odometry gets wrong",
      "ortung learn-motion run1.rec run2.rec --robot robot.toml --out motion.toml", runLearnMotion);
  build.option("sources", a->sources, "Records, or sources KIND:PATH?key=value")->required();
  build.option("--robot", a->robot, "Robot file (TOML)")->required();
  build
      .option("--out", a->out,
              "File to write, with the table [motion] for a robot file or eval --motion")
      ->required();
  build
      .option(
          "--plugin", a->plugin,
          "Motion model to teach (default: that of the robot file); `ortung plugins` lists them")
      ->capture_default_str();
  build.option("--motion", a->motion,
               "File with [motion] to begin with, e.g. with a network; in place of --plugin");
  build.option("--interval", a->interval, "Length of the shortest pieces of motion [s]")
      ->check(within(0.05, 60.0))
      ->capture_default_str();
  build.option("--from", a->from, "Learn from here on only, a share of each log's time")
      ->check(within(0.0, 1.0))
      ->capture_default_str();
  build.option("--to", a->to, "Learn up to here only, a share of each log's time")
      ->check(within(0.0, 1.0))
      ->capture_default_str();
  build.option("--delay", a->delay, "How far odometry is ahead of the robot [s]; default: learned")
      ->check(within(-0.3, 2.0));
  build.flag("--force", a->force, kForce);
  build.flag("--progress", a->progress, kProgress);
}

void addTrainMotion(Builder& build, CLI::App& app) {
  const auto a = build.command<TrainMotionArguments>(
      app, "train-motion", "Train a neural network on how a robot answers to commands",
      "ortung train-motion run.rec --robot robot.toml --out motion.json", runTrainMotion);
  build.option("sources", a->sources, "Records, or sources KIND:PATH?key=value, with ground truth")
      ->required();
  build.option("--robot", a->robot, "Robot file (TOML)")->required();
  build.option("--out", a->out, "Network to write (JSON)")->required();
  build
      .option("--commands-from", a->commandsFrom,
              "Where odometry has the commanded velocities: its own velocities, the last two words "
              "of its "
              "motion_data, or auto: motion_data where there is some")
      ->check(CLI::IsMember({"auto", "velocities", "motion_data"}))
      ->capture_default_str();
  build.option("--step", a->step, "Time that a prediction covers [s]")
      ->check(within(0.01, 1.0))
      ->capture_default_str();
  build.option("--commands", a->commands, "How many of the newest commands the network sees")
      ->check(within(1, 64))
      ->capture_default_str();
  build.option("--hidden", a->hidden, "Widths of the layers between")->capture_default_str();
  build.option("--iterations", a->iterations, "Steps of the training")
      ->check(within(1, 100000))
      ->capture_default_str();
  build.option("--hold-out", a->holdOut, "Share of each log, at its end, to test with")
      ->check(within(0.0, 0.9))
      ->capture_default_str();
  build.option("--seed", a->seed, "Seed of the first weights")->capture_default_str();
  build.flag("--force", a->force, kForce);
  build.flag("--progress", a->progress, kProgress);
}

}  // namespace ortung::app

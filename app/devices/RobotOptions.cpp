#include "CommandModule.hpp"
#include "LocalizationArguments.hpp"
#include "OptionBuilder.hpp"
#include "Robot.hpp"
#include "ServingOptions.hpp"

namespace ortung::app {
namespace {

void addLocalization(Builder& build, LocalizationArguments& a) {
  build.option("--tables", a.tables, "Table file of `ortung learn`: localize, too");
  const HelpGroup group(build, "Localization");
  build.option("--seed", a.seed, "Seed of all random numbers").showsDefault();
  build.option("--particles", a.particles, "Greatest number of samples; default: the robot file's")
      .within(1, 1e7);
  build.option("--threads", a.threads, "Threads of MCL; the result does not depend on it")
      .within(1, 256);
  build.option("--start", a.start, "global, truth (the first ground truth) or x,y,theta_deg")
      .showsDefault();
  build.option("--start-sigma", a.startSigma, "Standard deviations m,deg of a known start")
      .showsDefault();
  build.option("--motion", a.motion,
               "File with [motion], e.g. of `ortung learn-motion`; default: the robot file's");
  build.flag("--force", a.force, kForce);
}

void addRobot(Builder& build) {
  const auto a = build.command<RobotArguments>(
      "robot", "ortung robot robot.toml --tables hall.ortung --record run.rec --listen 7777",
      runRobot);
  build.option("robot", a->localization.robot, "Robot file (TOML) whose sensors name devices")
      .required();
  build.option("--dev", a->dev,
               "Folder in place of /dev, e.g. that of `ortung emulate --dev`: the same robot file "
               "with emulated devices");
  build.option("--record", a->record, "Write all readings as a record");
  build.option("--out", a->out, "Write a pose for each update of MCL, as `ortung localize` does");
  build.option("--duration", a->duration, "Time to run [s]; default: until a signal")
      .within(0.0, 1e9);
  addLocalization(build, a->localization);
  addDoor(build, a->serving);
  addRecording(build, a->serving);
}

}  // namespace
}  // namespace ortung::app

ORTUNG_COMMAND_MODULE(ortung::app::addRobot)

#include "DeviceCommands.hpp"

#include <memory>
#include <string>

#include "Commands.hpp"
#include "OptionBuilder.hpp"
#include "ServingOptions.hpp"

namespace ortung::app {
namespace {

void addLocalization(Builder& build, LocalizationArguments& a) {
  build.option("--tables", a.tables, "Table file of `ortung learn`: localize, too");
  build.option("--seed", a.seed, "Seed of all random numbers")->capture_default_str();
  build.option("--particles", a.particles, "Most samples; default: the robot file's")
      ->check(within(1, 1e7));
  build.option("--threads", a.threads, "Threads of MCL; the result does not depend on it")
      ->check(within(1, 256));
  build.option("--start", a.start, "global, truth (the first ground truth) or x,y,theta_deg")
      ->capture_default_str();
  build.option("--start-sigma", a.startSigma, "Standard deviations m,deg of a known start")
      ->capture_default_str();
  build.option("--motion", a.motion,
               "File with [motion], e.g. of `ortung learn-motion`; default: the robot file's");
  build.flag("--force", a.force, kForce);
}

}  // namespace

void addRobot(Builder& build, CLI::App& app) {
  const auto a = build.command<RobotArguments>(
      app, "robot", "Read a real robot's devices; record, localize and serve what they say",
      "ortung robot robot.toml --tables hall.ortung --record run.rec --listen 7777", runRobot);
  build.option("robot", a->localization.robot, "Robot file (TOML) whose sensors name devices")
      ->required();
  build.option("--dev", a->dev,
               "Folder in place of /dev, e.g. that of `ortung emulate --dev`: the same robot file "
               "with emulated devices");
  build.option("--record", a->record, "Write all readings as a record");
  build.option("--out", a->out, "Write a pose for each update of MCL, as `ortung localize` does");
  build.option("--duration", a->duration, "How long to run [s]; default: until a signal")
      ->check(within(0.0, 1e9));
  addLocalization(build, a->localization);
  addDoor(build, a->serving);
  addRecording(build, a->serving);
}

void addEmulate(Builder& build, CLI::App& app) {
  const std::string example =
      "ortung emulate sick --robot maps/robots/laboratory.toml --world maps/fields/arena.toml "
      "--link /tmp/sick\n"
      "  ortung emulate --robot robot.toml --source record:run.rec --dev /tmp/dev";
  const auto a = build.command<EmulateArguments>(
      app, "emulate", "Be the devices of a robot, as their drivers see them", example.c_str(),
      runEmulate);
  build
      .option("device", a->kind,
              "sick, hokuyo, base or lines; all: those that the robot file's sensors name")
      ->check(CLI::IsMember({"sick", "hokuyo", "base", "lines", "all"}))
      ->capture_default_str();
  build.option("--robot", a->robot, "Robot file (TOML)")->required();
  build.option("--world", a->world, "World or scene in which a simulated robot measures");
  build.option("--source", a->source, "What the devices measure instead: KIND:PATH?key=value");
  build.option("--dev", a->dev,
               "Folder for links to the pseudo-terminals, named like the ports of the robot file");
  build.option("--link", a->link, "Link to the pseudo-terminal of a single device");
  build.option("--tcp", a->tcp, "Port of a single device that is a server instead")
      ->check(within(0, 65535));
  build.option("--baud", a->baud, "Speed of a single device [bit/s]; default: as it is shipped")
      ->check(within(1200, 1e6));
  build
      .option("--fault", a->faults,
              "[DEVICE=]KIND[:VALUE][@FROM-TO], see below; may be given again")
      ->expected(1)
      ->take_all();
  build.option("--clock-offset", a->clockOffset, "What the devices' clocks show at the start [s]")
      ->check(within(0.0, 1e6))
      ->capture_default_str();
  build.option("--clock-drift-ppm", a->clockDriftPpm, "How much too fast their clocks run")
      ->check(within(-1e5, 1e5))
      ->capture_default_str();
  build.option("--speed", a->speed, "Times real time")
      ->check(within(0.01, 100.0))
      ->capture_default_str();
  build.flag("--wait", a->waits,
             "Time begins when all devices have been asked to measure; default: at once");
  build.option("--seed", a->seed, "Seed of noise on the line, and of the simulated run")
      ->capture_default_str();
  build.app().footer("Faults (times in seconds since the start):\n" + emulateHelp() +
                     "Example:\n  " + example);
}

}  // namespace ortung::app

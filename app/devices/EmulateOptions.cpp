#include "CommandModule.hpp"
#include "Emulate.hpp"
#include "OptionBuilder.hpp"

namespace ortung::app {
namespace {

void addEmulate(Builder& build) {
  const std::string example =
      "ortung emulate sick --robot maps/robots/laboratory.toml --world maps/fields/arena.toml "
      "--link /tmp/sick\n"
      "  ortung emulate --robot robot.toml --source record:run.rec --dev /tmp/dev";
  const auto a = build.command<EmulateArguments>("emulate", example, runEmulate);
  build
      .option("device", a->kind,
              "sick, hokuyo, base or lines; all: those that the robot file's sensors name")
      .oneOf({"sick", "hokuyo", "base", "lines", "all"})
      .showsDefault();
  build.option("--robot", a->robot, "Robot file (TOML)").required();
  build.option("--world", a->world, "World or scene in which a simulated robot measures");
  build.option("--source", a->source, "Source of the readings instead: KIND:PATH?key=value");
  build.option("--dev", a->dev,
               "Folder for links to the pseudo-terminals, named like the ports of the robot file");
  build.option("--link", a->link, "Link to the pseudo-terminal of a single device");
  build.option("--tcp", a->tcp, "Port of a single device that is a server instead")
      .within(0, 65535);
  build.option("--baud", a->baud, "Speed of a single device [bit/s]; default: that of a new one")
      .within(1200, 1e6);
  build
      .option("--fault", a->faults,
              "[DEVICE=]KIND[:VALUE][@FROM-TO], see below; may be given again")
      .repeats();
  build.option("--clock-offset", a->clockOffset, "Time of the devices' clocks at the start [s]")
      .within(0.0, 1e6)
      .showsDefault();
  build.option("--clock-drift-ppm", a->clockDriftPpm, "How much too fast their clocks run [ppm]")
      .within(-1e5, 1e5)
      .showsDefault();
  build.option("--speed", a->speed, "Speed relative to real time")
      .within(0.01, 100.0)
      .showsDefault();
  build.flag("--wait", a->waits, "Begin when all devices were asked to measure; default: at once");
  build.option("--seed", a->seed, "Seed of the noise on the line, and of the simulation")
      .showsDefault();
  build.footer([example] {
    return "Faults (times in seconds since the start):\n" + emulateHelp() + "Example:\n  " +
           example;
  });
}

}  // namespace
}  // namespace ortung::app

ORTUNG_COMMAND_MODULE(ortung::app::addEmulate)

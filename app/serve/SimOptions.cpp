#include "CommandModule.hpp"
#include "Demo.hpp"
#include "OptionBuilder.hpp"
#include "ServingOptions.hpp"
#include "Sim.hpp"

namespace ortung::app {
namespace {

void addDemo(Builder& build) {
  const auto a = build.command<DemoArguments>("demo", "ortung demo", runDemo);
  build.flag(
      "--once", a->once,
      "Without a browser: print the robot's pose when it is localized, and its error, and end");
  addDoor(build, a->serving);
  addRecording(build, a->serving);
}

void addSim(Builder& build) {
  const auto a = build.command<SimArguments>(
      "sim",
      "ortung sim maps/scenes/kick.toml --duration 60 --free-run --record run.rec\n"
      "  ortung sim maps/fields/f2000.toml --listen 7777",
      runSim);
  build.option("world", a->world, "World or scene file (TOML)").required();
  build
      .option("--robot", a->robots,
              "Robot file (TOML) of a robot that wanders about; may be given again")
      .repeats();
  build.group("Game");
  build
      .option(
          "--player", a->players,
          "PLUGIN[:key=value&key=value...][@TEAM]: a player on a robot of its own, e.g. "
          "wander:robot=maps/robots/pioneer.toml&speed_m_s=0.5@blue; robot, name, start (x,y,deg) "
          "and stage (yes, no) are for all, `ortung plugins` shows the others; may be given again")
      .repeats();
  build.option("--referee", a->referee,
               "PLUGIN[:key=value&key=value...]: the referee, e.g. soccer:league=msl");
  build.option("--refbox", a->refBox,
               "HOST[:PORT][@TEAM]: a RefBox of the Middle Size League controls the game, and gets "
               "the places of TEAM (blue). With --referee soccer:control=orders");
  build
      .option("--player-budget-ms", a->playerBudgetMs,
              "Processor time of a call after which a player is stopped [ms]; 0: unlimited")
      .within(0.0, 1e6)
      .showsDefault();
  build.group("Course");
  build
      .option("--duration", a->duration,
              "Time to simulate [s]; default: the scene's, or until a signal")
      .within(0.0, 1e6);
  build.group("Results");
  build.option("--record", a->record, "Write all readings of one robot as a record");
  build.option("--recorded", a->recorded, "Name of the robot to record; default: the first");
  build.option("--trace", a->trace, "Write the places of all bodies, 20 times a second, as CSV");
  build.flag("--digest", a->digest, "Print a hash of the simulation: equal for equal runs");
  build.group("Course");
  build.option("--threads", a->threads, "Threads for the sensors; the result does not depend on it")
      .within(1, 256);
  build.option("--seed", a->seed, "Seed of all random numbers").showsDefault();
  build
      .option("--cycle-ms", a->cycleMs,
              "Time between two steps of the simulation [ms]; default: the world's")
      .within(0.1, 1000.0);
  build.flag("--no-noise", a->noNoise, "Sensors and odometry without noise");
  build.flag("--force", a->force, kForce);
  build.group("Localization");
  build
      .option("--localize", a->localize,
              "With --listen: names of robots (NAME,NAME,... or all) that are localized from the "
              "beginning, for clients, which may begin and end it, too (LOCALIZE)")
      .splitsAt(',');
  build.option(
      "--tables", a->tables,
      "Table file for that, of `ortung learn`; default: learned when the first one begins");
  addServing(build, a->serving);
  addRecording(build, a->serving);
}

}  // namespace
}  // namespace ortung::app

ORTUNG_COMMAND_MODULE(ortung::app::addDemo, ortung::app::addSim)

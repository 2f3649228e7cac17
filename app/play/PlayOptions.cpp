#include "CommandModule.hpp"
#include "OptionBuilder.hpp"
#include "Play.hpp"

namespace ortung::app {
namespace {

void addPlay(Builder& build) {
  const auto a = build.command<PlayArguments>(
      "play", "ortung play 'seeker:robot=pioneer.toml@blue' --server 127.0.0.1:7777", runPlay);
  build
      .option(
          "player", a->player,
          "PLUGIN[:key=value&key=value...][@TEAM]; robot, name and start (x,y,deg) are for all, "
          "`ortung plugins` shows the others")
      .required();
  build.option("--server", a->server, "HOST:PORT of `ortung sim --listen`").required();
  build.option("--token-file", a->tokens,
               "File with a line 'NAME TOKEN' for the robot's name, or * for any; default: "
               "$ORTUNG_TOKEN");
  build.option("--tables", a->tables,
               "Table file of `ortung learn`: what the robot's features expect, and the field");
  build.flag("--lockstep", a->lockstep,
             "The world advances only when the player has acted (the server's --lockstep)");
  build
      .option("--player-budget-ms", a->budgetMs,
              "Processor time of a call after which the player is stopped [ms]; 0: "
              "unlimited")
      .within(0.0, 1e6)
      .showsDefault();
  build
      .option("--duration", a->duration,
              "Time to play [s]; default: until the player ends, or a signal")
      .within(0.0, 1e6);
  build.option("--seed", a->seed, "Seed of the player's random numbers").showsDefault();
}

}  // namespace
}  // namespace ortung::app

ORTUNG_COMMAND_MODULE(ortung::app::addPlay)

#include "CommandModule.hpp"
#include "Check.hpp"
#include "OptionBuilder.hpp"

namespace ortung::app {
namespace {

void addCheck(Builder& build) {
  const auto a = build.command<CheckArguments>(
      "check", "ortung check hall.ortung --world hall.toml --robot robot.toml", runCheck);
  build.option("files", a->files, "Files; their contents say what they are").required();
  build.option("--world", a->world, "World that the tables must have been learned in");
  build.option("--robot", a->robot, "Robot that the tables must have been learned for");
  build.flag("--mend", a->mend,
             "Cut off what a killed recorder left of the last moment of a record");
}

}  // namespace
}  // namespace ortung::app

ORTUNG_COMMAND_MODULE(ortung::app::addCheck)

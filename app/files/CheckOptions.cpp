#include "Check.hpp"
#include "CommandModule.hpp"
#include "OptionBuilder.hpp"

namespace ortung::app {
namespace {

void addCheck(Builder& build) {
  const auto a = build.command<CheckArguments>(
      "check", "ortung check hall.ortung --world hall.toml --robot robot.toml", runCheck);
  build.option("files", a->files, "Files; their kinds are recognized by their content");
  build.option("--world", a->world, "World in which the tables must have been learned");
  build.option("--robot", a->robot, "Robot for which the tables must have been learned");
  build
      .option("--schema", a->schema,
              "Print the JSON schema of a kind of file, for editors that complete and check TOML")
      .oneOf({"robot", "world", "scene"});
  build.flag("--wire", a->wire,
             "Show the words and the format of each feature's readings in records and on the wire, "
             "in place of a robot's sensors");
  build.flag("--mend", a->mend, "Cut off the incomplete end of a record whose recorder was killed");
}

}  // namespace
}  // namespace ortung::app

ORTUNG_COMMAND_MODULE(ortung::app::addCheck)

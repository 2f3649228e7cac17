#include <fmt/format.h>

#include <string_view>

#include "CommandModule.hpp"
#include "Import.hpp"
#include "OptionBuilder.hpp"

namespace ortung::app {
namespace {

void addImport(Builder& build) {
  const auto a =
      build.command<ImportArguments>("import",
                                     "ortung import mrclam data/ds6 --out ds6-3.rec --robot 3 "
                                     "--world ds6.toml --robot-file ds6-3.toml",
                                     runImport);
  // This is made when the help is printed, and then has the kind before --help.
  build.footer([a] { return importHelp(a->kind.substr(0, a->kind.find(':'))); });
  build.option("kind", a->kind, "Kind of source, or KIND:SOURCE?key=value; see below").required();
  build.option("source", a->source, "File or folder to read, if KIND does not name it");
  build.option("--out", a->out, "Record file to write").required();
  build.option("--world", a->world,
               "Also write the world file, and the maps that it names beside it");
  build.option("--robot-file", a->robotFile, "Also write a robot file that fits");
  build.option("--option", a->options, "key=value, an option of the source; may be given again")
      .repeats();
  for (const char* key : {"robot", "laser_x"}) {
    const bool isRobot = std::string_view(key) == "robot";
    build.shortcut(
        isRobot ? "--robot" : "--laser-x",
        isRobot ? "Number of the robot; short for --option robot=N"
                : "Place of the laser on the robot's x axis [m]; short for --option laser_x=M",
        [a, key](const std::string& value) {
          a->options.push_back(fmt::format("{}={}", key, value));
        });
  }
  build.option("--with-robot", a->withRobot, "Robot file to read, for sources that need one (sim)");
  build.flag(
      "--force", a->force,
      "Overwrite world and robot files that exist, and files of other kinds (but never files "
      "that the run reads)");
  build.flag("--progress", a->progress, kProgress);
}

}  // namespace
}  // namespace ortung::app

ORTUNG_COMMAND_MODULE(ortung::app::addImport)

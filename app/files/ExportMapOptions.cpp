#include "CommandModule.hpp"
#include "ExportMap.hpp"
#include "OptionBuilder.hpp"

namespace ortung::app {
namespace {

void addMap(Builder& build) {
  const auto a = build.command<ExportMapArguments>(
      "export map", "ortung export map maps/fields/f2000_hall.toml --out hall.gridmap",
      runExportMap);
  build.option("world", a->world, "World file (TOML)").required();
  build
      .option("--out", a->out,
              "File to write: NAME.yaml as map_server has it, with the picture NAME.pgm beside it, "
              "or NAME.gridmap of MRPT")
      .required();
  build.option("--cell", a->cell, "Edge of a cell [m]").within(0.005, 10.0).showsDefault();
  build.option("--height", a->height, "How high over the floor the scanner is [m]")
      .within(0.0, 100.0)
      .showsDefault();
  build.flag("--force", a->force, kForce);
}

}  // namespace
}  // namespace ortung::app

ORTUNG_COMMAND_MODULE(ortung::app::addMap)

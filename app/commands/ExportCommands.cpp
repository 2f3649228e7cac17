#include "ExportCommands.hpp"

#include "Commands.hpp"
#include "ExportImagesCommand.hpp"
#include "OptionBuilder.hpp"

namespace ortung::app {
namespace {

void addRawlog(Builder& build, CLI::App& app) {
  const auto a = build.command<ExportRawlogArguments>(
      app, "rawlog", "Turn readings into a rawlog, for MRPT's tools",
      "ortung export rawlog record:run.rec --robot robot.toml --out run.rawlog", runExportRawlog);
  build.option("source", a->source, kSource)->required();
  build.option("--robot", a->robot, "Robot file (TOML): what the readings mean")->required();
  build.option("--out", a->out, "Rawlog to write")->required();
  build.option("--truth", a->truth, "Also write where the robot was: lines 'seconds x y theta'");
  build.flag("--force", a->force, kForce);
  build.flag("--progress", a->progress, kProgress);
}

void addMap(Builder& build, CLI::App& app) {
  const auto a = build.command<ExportMapArguments>(
      app, "map", "Draw what a scanner sees of a world as a grid map",
      "ortung export map maps/fields/f2000_hall.toml --out hall.gridmap", runExportMap);
  build.option("world", a->world, "World file (TOML)")->required();
  build
      .option("--out", a->out,
              "File to write: NAME.yaml as map_server has it, with the picture NAME.pgm beside it, "
              "or NAME.gridmap of MRPT")
      ->required();
  build.option("--cell", a->cell, "Edge of a cell [m]")
      ->check(within(0.005, 10.0))
      ->capture_default_str();
  build.option("--height", a->height, "How high over the floor the scanner is [m]")
      ->check(within(0.0, 100.0))
      ->capture_default_str();
  build.flag("--force", a->force, kForce);
}

}  // namespace

void addExport(Builder& build, CLI::App& app) {
  CLI::App* group = app.add_subcommand("export", "Turn what is Ortung's into files of others");
  group->require_subcommand(1);
  group->footer(
      "Example:\n  ortung export rawlog record:run.rec --robot robot.toml --out run.rawlog");
  addRawlog(build, *group);
  addMap(build, *group);
  addExportImages(build, *group);
}

}  // namespace ortung::app

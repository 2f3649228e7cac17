#include "ExportCommands.hpp"

#include "Commands.hpp"
#include "ExportImagesCommand.hpp"
#include "LocalizationCommands.hpp"
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

#ifdef ORTUNG_HAS_ROS2
void addMcap(Builder& build, CLI::App& app) {
  const auto a = build.command<ExportMcapArguments>(
      app, "mcap", "Turn readings into messages of ROS 2 in an MCAP file",
      "ortung export mcap record:run.rec --robot robot.toml --tables robot.tables --out run.mcap",
      runExportMcap);
  build.option("source", a->source, kSource)->required();
  build.option("--robot", a->robot, "Robot file (TOML): what the readings mean")->required();
  build.option("--out", a->out, "MCAP file to write")->required();
  build.option("--tables", a->tables, "Tables of the robot, of which /map is drawn");
  build.option("--world", a->world, "World file (TOML), of which /map is drawn");
  build.option("--cell", a->cell, "Edge of a cell of a world's map [m]")
      ->check(within(0.005, 10.0))
      ->capture_default_str();
  build.option("--height", a->height, "How high over the floor that map is drawn [m]")
      ->check(within(0.0, 100.0))
      ->capture_default_str();
  build
      .option("--map-frame", a->mapFrame,
              "What /tf says of odometry's frame in the map: best (the estimate that the record "
              "has, else the ground truth), truth, or none, for who localizes the robot himself")
      ->check(CLI::IsMember({"best", "truth", "none"}))
      ->capture_default_str();
  build.flag("--force", a->force, kForce);
  build.flag("--progress", a->progress, kProgress);
}
#endif

void addHtml(Builder& build, CLI::App& app) {
  const auto a = build.command<ExportHtmlArguments>(
      app, "html", "Put records into one page that any browser shows, without a server",
      "ortung export html run.rec --robot robot.toml --tables hall.ortung --out run.html",
      runExportHtml);
  addRuns(build, a->runs);
  build.option("--out", a->out, "Page to write")->required();
  build.flag("--force", a->force, kForce);
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
  addHtml(build, *group);
  addMap(build, *group);
#ifdef ORTUNG_HAS_ROS2
  addMcap(build, *group);
#endif
  addExportImages(build, *group);
}

}  // namespace ortung::app

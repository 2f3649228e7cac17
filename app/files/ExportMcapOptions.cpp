#include "CommandModule.hpp"
#include "ExportMcap.hpp"
#include "OptionBuilder.hpp"

namespace ortung::app {
namespace {

void addMcap(Builder& build) {
  const auto a = build.command<ExportMcapArguments>(
      "export mcap",
      "ortung export mcap record:run.rec --robot robot.toml --tables robot.tables --out run.mcap",
      runExportMcap);
  build.option("source", a->source, kSource).required();
  build.option("--robot", a->robot, "Robot file (TOML): what the readings mean").required();
  build.option("--out", a->out, "MCAP file to write").required();
  build.option("--tables", a->tables, "Tables of the robot, of which /map is drawn");
  build.option("--world", a->world, "World file (TOML), of which /map is drawn");
  build.option("--cell", a->cell, "Edge of a cell of a world's map [m]")
      .within(0.005, 10.0)
      .showsDefault();
  build.option("--height", a->height, "How high over the floor that map is drawn [m]")
      .within(0.0, 100.0)
      .showsDefault();
  build
      .option("--map-frame", a->mapFrame,
              "What /tf says of odometry's frame in the map: best (the estimate that the record "
              "has, else the ground truth), truth, or none, for who localizes the robot himself")
      .oneOf({"best", "truth", "none"})
      .showsDefault();
  build.group("Localization");
  build.flag("--localize", a->localizes,
             "Localize with --tables first: estimates, samples and status are in the file, too");
  build.option("--start", a->start, "global, truth (the first ground truth) or x,y,theta_deg")
      .showsDefault();
  build.option("--seed", a->seed, "Seed of all random numbers").showsDefault();
  build.flag("--force", a->force, kForce);
  build.flag("--progress", a->progress, kProgress);
}

}  // namespace
}  // namespace ortung::app

ORTUNG_COMMAND_MODULE(ortung::app::addMcap)

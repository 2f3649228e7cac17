#include "CommandModule.hpp"
#include "MendMap.hpp"
#include "OptionBuilder.hpp"

namespace ortung::app {
namespace {

void addMendMap(Builder& build) {
  const auto a = build.command<MendMapArguments>(
      "mend-map",
      "ortung mend-map office.toml --changes robot.belief --out mended.toml --picture mended.png",
      runMendMap);
  build.option("world", a->world, "World file (TOML) whose map no longer fits").required();
  build
      .option("--changes", a->changes,
              "Where it no longer fits: a belief that `ortung localize` has saved "
              "(--belief), or a record with mcl/LOCALIZATION/map")
      .required();
  build
      .option("--out", a->out,
              "World file to write: NAME.toml, with the map NAME.yaml and NAME.pgm beside it")
      .required();
  build.option(
      "--picture", a->picture,
      "Picture to write (PNG): the map, what was found, and the proposal beside each other");
  build.option("--cell", a->cell, "Edge of a cell [m]").within(0.005, 0.1).showsDefault();
  build.option("--height", a->height, "How high over the floor the scanner is [m]")
      .within(0.0, 100.0)
      .showsDefault();
  build.flag("--force", a->force, kForce);
}

}  // namespace
}  // namespace ortung::app

ORTUNG_COMMAND_MODULE(ortung::app::addMendMap)

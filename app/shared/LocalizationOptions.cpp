#include "LocalizationOptions.hpp"

namespace ortung::app {

void addLocalization(Builder& build, LocalizationArguments& a, Localizes when) {
  const bool isAsked = when == Localizes::kIfAsked;
  Option robot = build.option("--robot", a.robot, "Robot file (TOML)");
  Option tables = build.option(
      "--tables", a.tables,
      isAsked ? "Table file of `ortung learn`: localize, too" : "Table file of `ortung learn`");
  if (!isAsked) {
    robot.required();
    tables.required();
  }
  const HelpGroup group(build, "Localization");
  build.option("--seed", a.seed, "Seed of all random numbers").showsDefault();
  build
      .option("--particles", a.particles,
              "Greatest number of samples; for a fixed number set mcl.min_particles of the robot "
              "file to the same, a smaller one lowers that; default: the robot file's")
      .within(1, 1e7);
  build.option("--threads", a.threads, "Threads; the result does not depend on it").within(1, 256);
  build.option("--start", a.start, "global, truth (the first ground truth) or x,y,theta_deg")
      .showsDefault();
  build.option("--start-sigma", a.startSigma, "Standard deviations m,deg of a known start")
      .showsDefault();
  build.option("--motion", a.motion,
               "File with [motion], e.g. of `ortung learn-motion`, or odometry noise "
               "turn_per_turn,turn_per_m,way_per_m,way_per_turn; default: the robot file's");
  build
      .option("--filter", a.filter,
              "mcl, or grid: all poses of a grid, as a reference on small fields; it "
              "neither recovers nor refines")
      .oneOf({"mcl", "grid"})
      .showsDefault();
  build.option("--grid", a.grid, "That grid's cell [m] and step of headings [degrees]")
      .showsDefault();
  build.flag("--any-world", a.anyWorld,
             "Accept a source from another world than that of the tables");
  build.flag("--progress", a.progress, kProgress);
}

void addRuns(Builder& build, ViewArguments& a) {
  build.option("records", a.sources, "Records or sources (KIND:PATH?key=value), shown side by side")
      .required()
      .expects(1, 16);
  build.option("--world", a.world, "World whose field is drawn; default: that of the tables");
  addLocalization(build, a.localization, Localizes::kIfAsked);
}

}  // namespace ortung::app

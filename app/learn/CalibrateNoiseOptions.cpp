#include "CalibrateNoise.hpp"
#include "CommandModule.hpp"
#include "OptionBuilder.hpp"

namespace ortung::app {
namespace {

void addNoise(Builder& build) {
  const auto a = build.command<CalibrateNoiseArguments>(
      "calibrate noise",
      "ortung calibrate noise run1.rec run2.rec --robot robot.toml --tables hall.ortung --out "
      "learned.toml",
      runCalibrateNoise);
  build.option("sources", a->sources, "Records, or sources KIND:PATH?key=value").required();
  build.option("--robot", a->robot, "Robot file (TOML)").required();
  build.option("--tables", a->tables, "Table file of `ortung learn`").required();
  build.option("--out", a->out, "Robot file to write: a copy with what was learned");
  build
      .option("--reference", a->reference,
              "Poses of the robot: truth, track (of MCL), or auto: truth if there is "
              "one")
      .oneOf({"auto", "truth", "track"})
      .showsDefault();
  build.option("--fixed", a->fixed, "What is not learned: bias, mount, latency")
      .oneOf({"bias", "mount", "latency"})
      .splitsAt(',');
  build.option("--motion", a->motion,
               "File with [motion] for the track; default: the robot file's");
  build.option("--seed", a->seed, "Seed of the track").showsDefault();
  build.flag("--any-world", a->anyWorld,
             "Accept sources from another world than that of the tables");
  build.shard(a->shard, a->job);
  build.flag("--force", a->force, kForce);
  build.flag("--progress", a->progress, kProgress);
}

}  // namespace
}  // namespace ortung::app

ORTUNG_COMMAND_MODULE(ortung::app::addNoise)

#include "CommandModule.hpp"
#include "Localize.hpp"
#include "LocalizationOptions.hpp"
#include "OptionBuilder.hpp"

namespace ortung::app {
namespace {

void addLocalize(Builder& build) {
  const auto a =
      build.command<LocalizeArguments>("localize",
                                       "ortung localize --source record:run.rec --robot robot.toml "
                                       "--tables hall.ortung --out poses.txt",
                                       runLocalize);
  build.option("--source", a->localization.source, kSource).required();
  addLocalization(build, a->localization, Localizes::kAlways);
  build.flag("--force", a->localization.force, kForce);
  build.option("--out", a->out, "File to write; default: stdout");
  build
      .option("--rate", a->rate,
              "Poses a second, at even times, carried on by odometry; default: one whenever "
              "readings weighed the belief")
      .within(0.01, 1000);
  build
      .option("--format", a->format,
              "text: a line of numbers a pose, which the first line names; json: an object a line; "
              "tum: seconds x y z qx qy qz qw, as evo reads it")
      .oneOf({"text", "json", "tum"})
      .showsDefault();
  build.option("--truth", a->truth, "Write the source's ground truth, too, as --format tum has it");
  build.option("--belief", a->belief,
               "Begin with the belief in this file, if it is there, in place of --start; save the "
               "belief there at the end, and every 10 s of a live source");
}

}  // namespace
}  // namespace ortung::app

ORTUNG_COMMAND_MODULE(ortung::app::addLocalize)

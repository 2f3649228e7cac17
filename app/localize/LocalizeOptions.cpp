#include "CommandModule.hpp"
#include "LocalizationOptions.hpp"
#include "Localize.hpp"
#include "OptionBuilder.hpp"
#include "RobotSettings.hpp"

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
  addSettings(build, a->localization.settings);
  build.flag("--force", a->localization.force, kForce);
  build.group("Results");
  build.option("--out", a->out, "File to write; default: stdout");
  build
      .option("--rate", a->rate,
              "Poses a second, at even times, predicted by odometry; default: one for each "
              "update")
      .within(0.01, 1000);
  build
      .option(
          "--format", a->format,
          "text: a line of numbers for each pose, named in the first line; json: an object a line; "
          "tum: seconds x y z qx qy qz qw, as evo reads it")
      .oneOf({"text", "json", "tum"})
      .showsDefault();
  build.option("--truth", a->truth, "Also write the source's ground truth, in the format tum");
  build.option("--record", a->record,
               "Also write all readings with MCL's results as a record, e.g. for `ortung view` and "
               "`ortung export mcap`");
  build.option("--belief", a->belief,
               "Begin with the belief in this file, if it exists, in place of --start; save the "
               "belief there at the end and, for a live source, every 10 s");
}

}  // namespace
}  // namespace ortung::app

ORTUNG_COMMAND_MODULE(ortung::app::addLocalize)

#include "CommandModule.hpp"
#include "OptionBuilder.hpp"
#include "Show.hpp"

namespace ortung::app {
namespace {

void addShow(Builder& build) {
  const auto a = build.command<ShowArguments>(
      "show",
      "ortung show hall.ortung --robot robot.toml --feature 'LMS200/LRF/*' --record run.rec --at "
      "12.5 --out heat.png",
      runShow);
  build.option("tables", a->tables, "Table file of `ortung learn`").required();
  build.option("--robot", a->robot, "Robot file (TOML)").required();
  build
      .option("--feature", a->features,
              "model/type/feature, * for any; given again: the product of all that match")
      .required()
      .repeats();
  build.option("--out", a->out, "Picture to write (PNG)").required();
  build.option("--record", a->record, "Record with the reading to weigh");
  build.option("--source", a->source, "Or any source with the reading to weigh");
  build.option("--at", a->at, "Time of the reading after the first one [s]")
      .within(0.0, 1e9)
      .showsDefault();
  build
      .option("--heading", a->headingDeg,
              "Heading of the robot [degrees]; default: 0 without a reading, else the best of all")
      .within(-360.0, 360.0);
  build.option("--beam", a->beam, "Which of the feature's values, from 0")
      .within(0, 8191)
      .showsDefault();
  build
      .option(
          "--scale", a->scale,
          "Colours of probabilities: linear, log, or auto: log where linear shows next to nothing")
      .oneOf({"auto", "linear", "log"})
      .showsDefault();
  build.flag("--log", a->logarithmic, "Short for --scale log");
  build.flag("--force", a->force, kForce);
  build.flag("--progress", a->progress, kProgress);
}

}  // namespace
}  // namespace ortung::app

ORTUNG_COMMAND_MODULE(ortung::app::addShow)

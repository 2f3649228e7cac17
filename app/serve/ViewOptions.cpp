#include "CommandModule.hpp"
#include "LocalizationOptions.hpp"
#include "OptionBuilder.hpp"
#include "ServingOptions.hpp"
#include "View.hpp"
#include "ViewArguments.hpp"

namespace ortung::app {
namespace {

void addView(Builder& build) {
  const auto a = build.command<ViewArguments>(
      "view",
      "ortung view run.rec\n"
      "  ortung view run.rec other.rec --robot robot.toml --tables hall.ortung",
      runView);
  addRuns(build, *a);
  addDoor(build, a->serving);
  const HelpGroup group(build, "Serving and viewing");
  build
      .option("--drop-limit", a->dropLimit,
              "Largest file that is opened when it is dropped on the page [MB]; 0: none is")
      .within(0, 1000000)
      .showsDefault();
}

}  // namespace
}  // namespace ortung::app

ORTUNG_COMMAND_MODULE(ortung::app::addView)

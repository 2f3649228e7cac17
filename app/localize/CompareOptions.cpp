#include "CommandModule.hpp"
#include "Compare.hpp"
#include "OptionBuilder.hpp"

namespace ortung::app {
namespace {

void addCompare(Builder& build) {
  const auto a = build.command<CompareArguments>("compare", "ortung compare before.json after.json",
                                                 runCompare);
  build.option("before", a->before, "JSON of `ortung eval --json`, of one run or of many: A")
      .required();
  build.option("after", a->after, "JSON of the same runs with another program or settings: B")
      .required();
  build.option("--json", a->json, "Write the comparison as JSON");
  build.flag("--force", a->force, kForce);
}

}  // namespace
}  // namespace ortung::app

ORTUNG_COMMAND_MODULE(ortung::app::addCompare)

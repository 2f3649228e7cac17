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
  build.option("after", a->after, "The same of the same runs, done otherwise: B").required();
  build.option("--json", a->json, "Write the comparison as JSON");
  build.flag("--force", a->force, kForce);
}

}  // namespace
}  // namespace ortung::app

ORTUNG_COMMAND_MODULE(ortung::app::addCompare)

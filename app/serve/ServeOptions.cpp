#include "CommandModule.hpp"
#include "OptionBuilder.hpp"
#include "Serve.hpp"
#include "ServingOptions.hpp"

namespace ortung::app {
namespace {

void addServe(Builder& build) {
  const auto a =
      build.command<ServeArguments>("serve", "ortung serve run.rec --listen 7777", runServe);
  build.option("record", a->record, "Record file").required();
  build.flag("--repeat", a->repeats, "Start over at the end");
  addServing(build, a->serving);
  addRecording(build, a->serving);
}

}  // namespace
}  // namespace ortung::app

ORTUNG_COMMAND_MODULE(ortung::app::addServe)

#include "CommandModule.hpp"
#include "ExportRawlog.hpp"
#include "OptionBuilder.hpp"

namespace ortung::app {
namespace {

void addRawlog(Builder& build) {
  const auto a = build.command<ExportRawlogArguments>(
      "export rawlog", "ortung export rawlog record:run.rec --robot robot.toml --out run.rawlog",
      runExportRawlog);
  build.option("source", a->source, kSource).required();
  build.option("--robot", a->robot, "Robot file (TOML): what the readings mean").required();
  build.option("--out", a->out, "Rawlog to write").required();
  build.option("--truth", a->truth, "Also write where the robot was: lines 'seconds x y theta'");
  build.flag("--force", a->force, kForce);
  build.flag("--progress", a->progress, kProgress);
}

}  // namespace
}  // namespace ortung::app

ORTUNG_COMMAND_MODULE(ortung::app::addRawlog)

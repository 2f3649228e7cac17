#include "CommandModule.hpp"
#include "ExportHtml.hpp"
#include "LocalizationOptions.hpp"
#include "OptionBuilder.hpp"

namespace ortung::app {
namespace {

void addHtml(Builder& build) {
  const auto a = build.command<ExportHtmlArguments>(
      "export html",
      "ortung export html run.rec --robot robot.toml --tables hall.ortung --out run.html",
      runExportHtml);
  addRuns(build, a->runs);
  build
      .option("--maps", a->maps,
              "Moments of each record with maps of p(s given l), events among them; default: 16 "
              "with --tables, else 0")
      .within(0, 1000);
  build.option("--out", a->out, "Page to write").required();
  build.flag("--force", a->force, kForce);
}

}  // namespace
}  // namespace ortung::app

ORTUNG_COMMAND_MODULE(ortung::app::addHtml)

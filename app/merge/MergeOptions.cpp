#include "CommandModule.hpp"
#include "Merge.hpp"
#include "OptionBuilder.hpp"

namespace ortung::app {
namespace {

void addMerge(Builder& build) {
  const auto a = build.command<MergeArguments>(
      "merge", "ortung merge parts/*.part --out building.ortung", runMerge);
  build.option("parts", a->parts, "Parts that commands with --shard have written, in any order")
      .required();
  build
      .option("--out", a->out,
              "What the command would have written: tables, figures, or a folder of pictures")
      .required();
  build.option("--html", a->html, "Also write the page of a benchmark");
  build.flag("--force", a->force, kForce);
  build.flag("--progress", a->progress, kProgress);
}

}  // namespace
}  // namespace ortung::app

ORTUNG_COMMAND_MODULE(ortung::app::addMerge)

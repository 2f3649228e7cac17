#include "CommandModule.hpp"
#include "OptionBuilder.hpp"
#include "Sweep.hpp"

namespace ortung::app {
namespace {

constexpr const char* kFile = "Sweep (TOML): command = [words with {key}], [vary] key = values";
constexpr const char* kDir = "Folder of the results; several machines may share it";

void addPlan(Builder& build) {
  const auto a = build.command<SweepPlanArguments>(
      "sweep plan", "ortung sweep plan particles.toml --dir particles", runSweepPlan);
  build.option("file", a->file, kFile).required();
  build.option("--dir", a->dir, "Folder of results: tell what tasks have cost, too");
}

void addRun(Builder& build) {
  const auto a = build.command<SweepRunArguments>(
      "sweep run", "ortung sweep run particles.toml --dir particles --shard 2/12", runSweepRun);
  build.option("file", a->file, kFile).required();
  build.option("--dir", a->dir, kDir).required();
  build.option("--shard", a->shard, "I/N: run the tasks of the I-th of N parts only")
      .showsDefault();
  build.option("--task", a->task,
               "Run the task of that name or id only, as `ortung sweep plan` lists them");
  build.option("--jobs", a->jobs, "Tasks that run at the same time").within(1, 256).showsDefault();
  build.flag("--progress", a->progress, kProgress);
}

void addStatus(Builder& build) {
  const auto a = build.command<SweepStatusArguments>(
      "sweep status", "ortung sweep status particles", runSweepStatus);
  build.option("dir", a->dir, kDir).required();
  build.flag("--all", a->all, "Name each task that is not done, not only the first ones");
}

void addTable(Builder& build) {
  const auto a = build.command<SweepTableArguments>(
      "sweep table", "ortung sweep table particles --by log,particles --html particles.html",
      runSweepTable);
  build.option("dir", a->dir, kDir).required();
  build.option("--by", a->by, "Keys that are kept; default: all but seed").splitsAt(',');
  build
      .option("--figures", a->figures,
              "Figures as in the JSON, e.g. lost_share,at_corrections.nees_mean; of many runs and "
              "cases (--runs, --kidnap, --wake-ups) summary.0.right.share,summary.0.after_s.p50")
      .splitsAt(',');
  build.option("--csv", a->csv, "Also write the table as CSV, with standard errors");
  build.option("--json", a->json, "Also write all figures of each task");
  build.option("--html", a->html, "Also write a page with curves and error bars");
  build.flag("--force", a->force, kForce);
}

}  // namespace
}  // namespace ortung::app

ORTUNG_COMMAND_MODULE(ortung::app::addPlan, ortung::app::addRun, ortung::app::addStatus,
                      ortung::app::addTable)

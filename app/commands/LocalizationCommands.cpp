#include "LocalizationCommands.hpp"

#include <memory>
#include <string>

#include "Commands.hpp"
#include "OptionBuilder.hpp"
#include "ServingOptions.hpp"
#include "ortung/run/Fault.hpp"

namespace ortung::app {
namespace {

constexpr const char* kSources =
    "KIND:PATH?key=value, e.g. record:run.rec; `ortung plugins` lists the kinds; may be given "
    "again";

void addLocalization(Builder& build, LocalizationArguments& a) {
  build.option("--robot", a.robot, "Robot file (TOML)")->required();
  build.option("--tables", a.tables, "Table file of `ortung learn`")->required();
  build.option("--seed", a.seed, "Seed of all random numbers")->capture_default_str();
  build.option("--particles", a.particles, "Most samples; default: the robot file's")
      ->check(within(1, 1e7));
  build.option("--threads", a.threads, "Threads; the result does not depend on it")
      ->check(within(1, 256));
  build.option("--start", a.start, "global, truth (the first ground truth) or x,y,theta_deg")
      ->capture_default_str();
  build.option("--start-sigma", a.startSigma, "Standard deviations m,deg of a known start")
      ->capture_default_str();
  build.option("--motion", a.motion,
               "File with [motion], e.g. of `ortung learn-motion`, or odometry noise "
               "turn_per_turn,turn_per_m,way_per_m,way_per_turn; default: the robot file's");
  build
      .option("--filter", a.filter,
              "mcl, or grid: all poses of a grid, exhaustively, as a reference on small fields; it "
              "neither recovers nor polishes")
      ->check(CLI::IsMember({"mcl", "grid"}))
      ->capture_default_str();
  build.option("--grid", a.grid, "Cell m and step of headings deg of that grid")
      ->capture_default_str();
  build.flag("--any-world", a.anyWorld,
             "Go on although the source comes from another world than the tables");
  build.flag("--force", a.force, kForce);
  build.flag("--progress", a.progress, kProgress);
}

}  // namespace

void addEval(Builder& build, CLI::App& app, const std::string& commandLine) {
  const std::string example =
      "ortung eval --source record:run.rec --robot robot.toml --tables hall.ortung --report "
      "run.html";
  const auto a = build.command<EvalArguments>(app, "eval", "Localize and compare with ground truth",
                                              example.c_str(), runEval);
  a->commandLine = commandLine;
  build.option("--source", a->sources, kSources)->required()->expected(1)->take_all();
  addLocalization(build, a->localization);
  build.option("--json", a->json, "Write the figures as JSON");
  build.option("--report", a->report, "Write a page with map, charts and figures");
  build.option(
      "--bound", a->bound,
      "World file of simulated sources, whose truth is exact: also tell how good estimates "
      "could be at all, the Cramer-Rao bound of readings and motion");
  build.flag("--against-grid", a->localization.besideGrid,
             "Also tell how far MCL's samples are from what the grid filter makes of the same "
             "readings");
  build.flag("--view", a->isViewing,
             "Show the run of the one source in a web browser afterwards, with a time line");
  build.option("--record", a->record, "Write all readings as a record");
  build
      .option("--converged-within", a->convergedWithin,
              "Error m,deg below which the filter has converged")
      ->capture_default_str();
  build
      .option("--fault", a->faults,
              "WHAT=FAULT[:VALUE][@FROM-TO], readings that go wrong; see below; may be given again")
      ->expected(1)
      ->take_all();
  build
      .option("--runs", a->runs,
              "Runs of each source, with the seeds from --seed on, on as many threads as --threads "
              "says or the machine has")
      ->check(within(1, 1e6))
      ->capture_default_str();
  build
      .option("--kidnap", a->kidnaps,
              "Cases made of each source: the robot tracks and is carried 8 m or more away")
      ->check(within(1, 1e6));
  build
      .option("--wake-ups", a->wakeUps,
              "Cases made of each source: an unknown start at a random moment, right within 5 m")
      ->check(within(1, 1e6));
  build
      .option("--teleport", a->teleport,
              "Kidnaps for each metre of way, e.g. 0.005, in each of --runs runs")
      ->check(within(1e-6, 1e3));
  build.app().footer(
      "Faults: WHAT is odometry, readings (all others) or a feature's name; times "
      "in seconds since the first reading:\n" +
      faultHelp() + "Example:\n  " + example +
      " --fault odometry=scale:1.2 --fault readings=crowd@20-50");
}

void addCompare(Builder& build, CLI::App& app) {
  const auto a = build.command<CompareArguments>(
      app, "compare", "Tell what got better or worse between two evaluations",
      "ortung compare before.json after.json", runCompare);
  build.option("before", a->before, "JSON of `ortung eval --json`, of one run or of many: A")
      ->required();
  build.option("after", a->after, "The same of the same runs, done otherwise: B")->required();
  build.option("--json", a->json, "Write the comparison as JSON");
  build.flag("--force", a->force, kForce);
}

void addRuns(Builder& build, ViewArguments& a) {
  build
      .option("records", a.sources, "Records or sources (KIND:PATH?key=value), shown side by side")
      ->required()
      ->expected(1, 16);
  build.option("--world", a.world, "World whose field is drawn; default: that of the tables");
  build.option("--robot", a.localization.robot, "Robot file (TOML)");
  build.option("--tables", a.localization.tables, "Table file of `ortung learn`: localize, too");
  build.option("--seed", a.localization.seed, "Seed of all random numbers")->capture_default_str();
  build.option("--start", a.localization.start, "global, truth or x,y,theta_deg")
      ->capture_default_str();
  build.flag("--any-world", a.localization.anyWorld,
             "Go on although the source comes from another world than the tables");
  build.flag("--progress", a.localization.progress, kProgress);
}

void addView(Builder& build, CLI::App& app) {
  const auto a = build.command<ViewArguments>(
      app, "view",
      "Look at records in a web browser, with a time line; with --tables, localize them first",
      "ortung view run.rec\n"
      "  ortung view run.rec other.rec --robot robot.toml --tables hall.ortung",
      runView);
  addRuns(build, *a);
  addDoor(build, a->serving);
}

void addLocalize(Builder& build, CLI::App& app) {
  const auto a =
      build.command<LocalizeArguments>(app, "localize", "Localize and write poses with covariance",
                                       "ortung localize --source record:run.rec --robot robot.toml "
                                       "--tables hall.ortung --out poses.txt",
                                       runLocalize);
  build.option("--source", a->localization.source, kSource)->required();
  addLocalization(build, a->localization);
  build.option("--out", a->out, "File to write; default: stdout");
  build
      .option("--rate", a->rate,
              "Poses a second, at even times, carried on by odometry; default: one whenever "
              "readings weighed the belief")
      ->check(within(0.01, 1000));
  build
      .option("--format", a->format,
              "text: a line of numbers a pose, which the first line names; json: an object a line; "
              "tum: seconds x y z qx qy qz qw, as evo reads it")
      ->check(CLI::IsMember({"text", "json", "tum"}))
      ->capture_default_str();
  build.option("--truth", a->truth, "Write the source's ground truth, too, as --format tum has it");
  build.option("--belief", a->belief,
               "Begin with the belief in this file, if it is there, in place of --start; save the "
               "belief there at the end, and every 10 s of a live source");
}

}  // namespace ortung::app

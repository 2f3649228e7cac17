#include "CommandModule.hpp"
#include "Eval.hpp"
#include "LocalizationOptions.hpp"
#include "OptionBuilder.hpp"
#include "RobotSettings.hpp"
#include "ortung/study/Fault.hpp"

namespace ortung::app {
namespace {

constexpr const char* kSources =
    "KIND:PATH?key=value, e.g. record:run.rec; `ortung plugins` lists the kinds; may be given "
    "again";

void addHarderRuns(Builder& build, EvalArguments& a) {
  build.group("Harder runs, and many of them");
  build
      .option("--fault", a.faults,
              "WHAT=FAULT[:VALUE][@FROM-TO], readings that go wrong; see below; may be given again")
      .repeats();
  build
      .option("--runs", a.runs,
              "Runs of each source, with the seeds from --seed on, on as many threads as --threads "
              "says or the machine has")
      .within(1, 1e6)
      .showsDefault();
  build
      .option("--kidnap", a.kidnaps,
              "Cases made of each source: the robot tracks and is carried 8 m or more away")
      .within(1, 1e6);
  build
      .option("--wake-ups", a.wakeUps,
              "Cases made of each source: an unknown start at a random time, right within 5 m")
      .within(1, 1e6);
  build
      .option("--teleport", a.teleport,
              "Kidnaps per metre travelled, e.g. 0.005, in each of --runs runs")
      .within(1e-6, 1e3);
}

void addEval(Builder& build) {
  const std::string example =
      "ortung eval --source record:run.rec --robot robot.toml --tables hall.ortung --report "
      "run.html";
  const auto a = build.command<EvalArguments>("eval", example, runEval);
  a->commandLine = build.commandLine();
  build.option("--source", a->sources, kSources).required().repeats();
  const std::size_t first = build.options();
  addLocalization(build, a->localization, Localizes::kAlways);
  build.keepGiven(first, a->localizationWords);
  addSettings(build, a->localization.settings);
  build.flag("--force", a->localization.force, kForce);
  build.group("Results");
  build.option("--json", a->json, "Write the figures as JSON");
  build.option("--report", a->report, "Write a page with map, charts and figures");
  build.option(
      "--bound", a->bound,
      "World file of simulated sources, whose truth is exact: also print how good estimates "
      "could be at all, the Cramer-Rao bound of readings and motion");
  build.flag("--against-grid", a->localization.besideGrid,
             "Also compare MCL's samples with the belief of the grid filter after the same "
             "readings");
  build.flag("--no-times", a->timesNothing,
             "Leave out how long updates took, so that equal runs write equal figures");
  build.flag("--view", a->isViewing,
             "Show the run of a single source in a web browser afterwards, with a time line");
  build.option("--record", a->record, "Write all readings as a record");
  build
      .option("--converged-within", a->convergedWithin,
              "Error m,deg below which the filter has converged")
      .showsDefault();
  addHarderRuns(build, *a);
  build.shard(a->shard, a->job);
  build.footer([example] {
    return "Faults: WHAT is odometry, readings (all others) or a feature's name; times in seconds\n"
           "since the first reading:\n" +
           faultHelp() + "Example:\n  " + example +
           " --fault odometry=scale:1.2 --fault readings=crowd@20-50";
  });
}

}  // namespace
}  // namespace ortung::app

ORTUNG_COMMAND_MODULE(ortung::app::addEval)

#include <fmt/format.h>

#include <memory>
#include <optional>

#include "Commands.hpp"
#include "Console.hpp"
#include "Localizing.hpp"
#include "Numbers.hpp"
#include "Outputs.hpp"
#include "Progress.hpp"
#include "Report.hpp"
#include "RunResult.hpp"
#include "SourceArguments.hpp"
#include "ortung/base/Angles.hpp"

namespace ortung::app {
namespace {

Evaluation::Options readOptions(const EvalArguments& arguments) {
  const std::vector<double> within =
      parseNumbers(arguments.convergedWithin, "--converged-within", {"m", "deg"});
  if (!(within[0] > 0.0 && within[1] > 0.0)) {
    throw UsageError("--converged-within is '" + arguments.convergedWithin +
                     "', expected numbers above 0");
  }
  Evaluation::Options options;
  options.convergedMetres = within[0];
  options.convergedRadians = radians(within[1]);
  return options;
}

std::vector<Fault> readFaults(const EvalArguments& arguments) {
  std::vector<Fault> faults;
  try {
    for (const std::string& text : arguments.faults) faults.push_back(parseFault(text));
  } catch (const FaultError& error) {
    throw UsageError(std::string("--fault: ") + error.what());
  }
  return faults;
}

/// Looks at them before the work, not after it.
Outputs outputsOf(const EvalArguments& arguments) {
  Outputs outputs(arguments.localization.force);
  declareInputs(arguments.localization, outputs);
  outputs.writes("--json", arguments.json, OutputKind::kFigures);
  outputs.writes("--report", arguments.report, OutputKind::kReport);
  outputs.writes("--record", arguments.record, OutputKind::kRecord);
  return outputs;
}

/// Runs MCL over the whole source. What is compared is what a program would have got that asks for
/// the pose at even times. Only odometry is taken from between two readings of it, since logs have
/// it thinned out that ran at tens of readings a second.
RunResult evaluate(const EvalArguments& arguments, const Evaluation::Options& options,
                   Localization& localization) {
  Evaluation evaluation(options);
  RunResult run;
  bool any = false;
  const auto onMoment = [&](const Feeder& feeder) {
    if (!any) run.first = feeder.stamp();
    any = true;
    localization.followOdometry();
    for (const Timestamp time : evaluation.due(feeder.stamp(), feeder.truth().has_value())) {
      const auto estimate = localization.estimate(time);
      if (!estimate) continue;
      evaluation.addMoment(*estimate);
      run.path.push_back(*estimate);
    }
    evaluation.addTime(feeder.stamp());
    if (feeder.truth()) evaluation.addTruth(feeder.stamp(), *feeder.truth());
  };
  Progress progress("localizing", arguments.localization.progress);
  while (const std::optional<EvaluationStep> step =
             nextStep(localization, arguments.localization, onMoment)) {
    evaluation.addStep(*step);
    run.estimates.push_back(step->estimate);
    run.path.push_back(step->estimate);
    progress.update(localization.feeder().progress());
  }
  run.figures = evaluation.result(arguments.localization.source);
  return run;
}

/// Says what keeps the figures from meaning anything.
void warnWithoutErrors(const RunResult& run) {
  if (run.figures.overTime.compared > 0) return;
  warn(run.figures.source +
       " gave no ground truth for any time with an estimate (a feature of type "
       "groundTruth), so there are no errors; `ortung localize` gives poses");
}

}  // namespace

int runEval(const EvalArguments& arguments) {
  const Evaluation::Options options = readOptions(arguments);
  const std::vector<Fault> faults = readFaults(arguments);
  const Outputs outputs = outputsOf(arguments);
  const std::unique_ptr<Localization> localization =
      openLocalization(arguments.localization, faults);
  std::optional<RecordWriter> record;
  if (!arguments.record.empty()) {
    const Source& source = localization->source();
    record.emplace(outputs.ready(arguments.record), source.worldFingerprint(), paceOf(source));
    localization->feeder().recordInto(*record);
  }
  RunResult run = evaluate(arguments, options, *localization);
  run.seed = localization->mclConfig().seed;
  run.particles = localization->mclConfig().maxSamples;
  run.robot = arguments.localization.robot.string();
  run.tables = arguments.localization.tables.string();
  run.tableInfo = localization->robot().tables;
  run.faults = arguments.faults;
  run.commandLine = arguments.commandLine;
  warnOf(arguments.localization.source, localization->source(), localization->feeder());
  warnWithoutOdometry(*localization, arguments.localization);
  requireUpdates(run.figures.steps, arguments.localization);
  warnWithoutErrors(run);
  if (record) record->commit();
  if (!arguments.json.empty()) outputs.write(arguments.json, toJson(run));
  if (!arguments.report.empty()) outputs.write(arguments.report, toHtml(run));
  fmt::print("{}", toText(run));
  return 0;
}

}  // namespace ortung::app

#include "Eval.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <memory>
#include <optional>
#include <stdexcept>
#include <system_error>
#include <thread>
#include <utility>

#include "Console.hpp"
#include "EvalParts.hpp"
#include "EvalRun.hpp"
#include "Localizing.hpp"
#include "ManyRuns.hpp"
#include "Numbers.hpp"
#include "Outputs.hpp"
#include "Progress.hpp"
#include "Report.hpp"
#include "RobotSettings.hpp"
#include "RunResult.hpp"
#include "SourceArguments.hpp"
#include "ortung/base/Angles.hpp"
#include "ortung/records/RecordWriter.hpp"

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

/// Returns all runs that the command line asks for, source by source.
std::vector<EvalJob> jobsOf(const EvalArguments& arguments) {
  std::vector<EvalJob> jobs;
  const bool isCases = arguments.kidnaps > 0 || arguments.wakeUps > 0;
  if (isCases && (arguments.runs > 1 || arguments.teleport))
    throw UsageError(
        "--kidnap and --wake-ups make runs of their own, with the seeds from --seed "
        "on; leave out --runs and --teleport");
  if ((isCases || arguments.teleport) && arguments.localization.start != "global" &&
      arguments.localization.start != "truth")
    throw UsageError("--start is '" + arguments.localization.start +
                     "', but kidnaps and teleports begin at the truth, wake-ups anywhere");
  for (const std::string& source : arguments.sources) {
    const std::size_t first = jobs.size();
    const bool isMade = isCases || arguments.teleport;
    const auto recording =
        isMade ? std::make_shared<SharedRecording>(source, arguments.localization.robot) : nullptr;
    const auto add = [&](RunKind kind, std::size_t count) {
      for (std::size_t i = 0; i < count; ++i)
        jobs.push_back({source, arguments.localization.seed + i, kind, i + 1, recording,
                        jobs.size() == first});
    };
    add(RunKind::kKidnap, arguments.kidnaps);
    add(RunKind::kWakeUp, arguments.wakeUps);
    if (arguments.teleport) add(RunKind::kTeleports, arguments.runs);
    if (!isMade) add(RunKind::kWhole, arguments.runs);
  }
  return jobs;
}

/// Declares the outputs, which checks them before the work, not after it.
Outputs outputsOf(const EvalArguments& arguments, std::size_t runs) {
  for (const auto& [option, file] :
       {std::pair("--report", arguments.report), std::pair("--record", arguments.record)}) {
    if (!file.empty() && runs > 1)
      throw UsageError(fmt::format("{} is for one run, and there are {}", option, runs));
  }
  Outputs outputs(arguments.localization.force);
  declareInputs(arguments.localization, outputs);
  for (const std::string& source : arguments.sources) outputs.readsSource(source);
  outputs.reads(arguments.bound);
  outputs.writes("--json", arguments.json,
                 arguments.shard.empty() ? OutputKind::kFigures : OutputKind::kPart);
  outputs.writes("--report", arguments.report, OutputKind::kReport);
  outputs.writes("--record", arguments.record, OutputKind::kRecord);
  return outputs;
}

RunResult runOne(const EvalSettings& settings, const EvalJob& job, const Outputs& outputs) {
  Progress progress("localizing", settings.arguments.localization.progress);
  EvalExtras extras;
  extras.progress = [&](double share) { progress.update(share); };
  if (!settings.arguments.record.empty()) {
    extras.record = [&](Localization& localization) {
      const Source& source = localization.source();
      return std::make_unique<RecordWriter>(outputs.ready(settings.arguments.record),
                                            notesOf(source, localization.container()),
                                            paceOf(source));
    };
  }
  return runJob(settings, job, extras);
}

std::vector<RunResult> runAll(const EvalSettings& settings, std::vector<EvalJob> jobs) {
  const auto count = static_cast<double>(jobs.size());
  Progress progress("localizing", settings.arguments.localization.progress);
  const unsigned threads = settings.arguments.localization.threads.value_or(
      std::max(1U, std::thread::hardware_concurrency()));
  return runJobs(settings, std::move(jobs), threads,
                 [&](std::size_t done) { progress.update(static_cast<double>(done) / count); });
}

/// Refuses live sources for many runs: they can be read only once.
void refuseLive(const EvalArguments& arguments, const std::vector<EvalJob>& jobs) {
  if (jobs.size() < 2) return;
  const std::unique_ptr<Robot> robot = openRobot(arguments.localization.robot);
  for (const std::string& source : arguments.sources) {
    if (openSourceArgument(source, arguments.localization.robot, robot->factory)->isLive())
      throw std::runtime_error(source +
                               ": is live, so its readings come once; expected a source that can "
                               "be played again for each of many runs, such as a record");
  }
}

/// Shows the same run, bit for bit, in the viewer: this process executes `ortung view`, whose
/// libraries an evaluation does not need. Returns only if that fails.
int viewAgain(const EvalArguments& arguments) {
  std::vector<std::string> words = {"ortung", "view", arguments.sources.front()};
  words.insert(words.end(), arguments.localizationWords.begin(), arguments.localizationWords.end());
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  flushOutput();
  ::execv("/proc/self/exe", pointers.data());
  throw std::runtime_error("--view: `ortung view` can't be run: " +
                           std::generic_category().message(errno));
}

void refuseToView(const EvalArguments& arguments, std::size_t jobs) {
  if (jobs == 1 && arguments.kidnaps + arguments.wakeUps == 0 && !arguments.teleport &&
      arguments.faults.empty() && arguments.localization.settings.empty())
    return;
  throw UsageError(
      "--view shows one run of one source as it is: it does not go with further sources or runs, "
      "faults, settings, kidnaps and wake-ups");
}

/// Makes the runs of a shard only, and writes them as a part.
int runShard(const EvalSettings& settings, std::vector<EvalJob> jobs, const Outputs& outputs) {
  const EvalArguments& arguments = settings.arguments;
  const Shard shard = readShard(arguments.shard);
  if (arguments.json.empty()) throw UsageError("--shard writes a part, expected its name: --json");
  if (!arguments.report.empty() || !arguments.record.empty() || arguments.isViewing)
    throw UsageError("--report, --record and --view do not go with --shard");
  refuseLive(arguments, jobs);
  const std::size_t all = jobs.size();
  EvalPart part;
  std::vector<EvalJob> own;
  for (std::size_t i = 0; i < all; ++i) {
    if (!shard.has(i)) continue;
    part.numbers.push_back(i);
    own.push_back(std::move(jobs[i]));
  }
  if (!own.empty())
    for (const RunResult& run : runAll(settings, std::move(own))) part.runs.push_back(keptOf(run));
  write(part, {kEvalParts, arguments.job, shard}, outputs.ready(arguments.json));
  fmt::print("{}: part {}, {} of {} runs\n", arguments.json.string(), toText(shard),
             part.runs.size(), all);
  return 0;
}

int evaluate(const EvalArguments& arguments) {
  if (arguments.localization.besideGrid && arguments.localization.filter == "grid")
    throw UsageError("--against-grid compares MCL with the grid filter, and --filter is grid");
  const EvalSettings settings{arguments, readOptions(arguments), readFaults(arguments)};
  std::vector<EvalJob> jobs = jobsOf(arguments);
  const Outputs outputs = outputsOf(arguments, jobs.size());
  if (arguments.isViewing) refuseToView(arguments, jobs.size());
  if (!arguments.shard.empty()) return runShard(settings, std::move(jobs), outputs);
  if (jobs.size() == 1 && jobs.front().kind == RunKind::kWhole) {
    const RunResult run = runOne(settings, jobs.front(), outputs);
    if (!arguments.json.empty()) outputs.write(arguments.json, toJson(run));
    if (!arguments.report.empty()) outputs.write(arguments.report, toHtml(run));
    fmt::print("{}", toText(run));
    return arguments.isViewing ? viewAgain(arguments) : 0;
  }
  refuseLive(arguments, jobs);
  std::vector<RunResult> runs;
  if (jobs.size() == 1) {
    runs.push_back(runOne(settings, jobs.front(), outputs));
    if (!arguments.report.empty()) outputs.write(arguments.report, toHtml(runs.front()));
  } else {
    runs = runAll(settings, std::move(jobs));
  }
  if (!arguments.json.empty()) outputs.write(arguments.json, toJson(runs));
  fmt::print("{}", toText(runs));
  return 0;
}

}  // namespace

int runEval(const EvalArguments& arguments) {
  return withSettings(arguments.localization.robot, arguments.localization.settings,
                      [&] { return evaluate(arguments); });
}

}  // namespace ortung::app

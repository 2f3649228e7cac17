#include "EvalRun.hpp"

#include <atomic>
#include <exception>
#include <limits>
#include <optional>
#include <stdexcept>
#include <thread>
#include <utility>

#include "Console.hpp"
#include "Localizing.hpp"
#include "SimulatedBound.hpp"
#include "SourceArguments.hpp"
#include "ortung/study/Cases.hpp"
#include "ortung/study/Disturbed.hpp"
#include "ortung/study/Verdict.hpp"

namespace ortung::app {
namespace {

constexpr Timestamp kEnd = std::numeric_limits<Timestamp>::max();
constexpr double kWakeUpDistance = 5.0;  ///< distance travelled in which a wake-up must succeed [m]
constexpr Timestamp kBetweenVerdicts = 2'000'000;  ///< time between two verdicts [us]
constexpr RightRule kTeleportRule{.metres = 0.45, .radians = 4.0, .seconds = 10.0};

std::shared_ptr<const Splice> spliceOf(const EvalSettings& settings, const EvalJob& job) {
  try {
    switch (job.kind) {
      case RunKind::kKidnap:
        return kidnapped(job.recording->get(), job.seed);
      case RunKind::kWakeUp:
        return wokenUp(job.recording->get(), job.seed, kWakeUpDistance);
      case RunKind::kTeleports:
        return teleported(job.recording->get(), job.seed, *settings.arguments.teleport);
      case RunKind::kWhole:
        break;
    }
  } catch (const std::invalid_argument& error) {
    throw std::runtime_error(error.what());
  }
  return nullptr;
}

RightRule ruleOf(const EvalSettings& settings, RunKind kind) {
  if (kind == RunKind::kTeleports) return kTeleportRule;
  RightRule rule{settings.options.convergedMetres, settings.options.convergedRadians,
                 settings.options.convergedSeconds};
  if (kind == RunKind::kWakeUp) rule.mostTravelled = kWakeUpDistance;
  return rule;
}

/// Returns the times from which on the estimate has to become right.
std::vector<Timestamp> beginningsOf(const Splice& splice, RunKind kind) {
  return kind == RunKind::kWakeUp ? std::vector<Timestamp>{splice.first()} : splice.joins();
}

/// Returns the events of a case with their results.
std::vector<CaseEvent> eventsOf(const EvalSettings& settings, const EvalJob& job,
                                const Splice& splice, const SensorContainer& robot,
                                const std::vector<EvaluationPoint>& points) {
  std::vector<CaseEvent> events;
  const std::vector<Timestamp> beginnings = beginningsOf(splice, job.kind);
  for (std::size_t i = 0; i < beginnings.size(); ++i) {
    const Timestamp until = i + 1 < beginnings.size() ? beginnings[i + 1] : kEnd;
    const Verdict verdict = judge(points, beginnings[i], until, ruleOf(settings, job.kind));
    CaseEvent event;
    event.at = toSeconds(beginnings[i] - splice.first());
    if (job.kind == RunKind::kWakeUp)
      event.at = toSeconds(splice.first() - splice.recording().messages().front().stamp);
    for (const EvaluationPoint& p : points) {
      if (p.stamp < beginnings[i]) continue;
      event.place = p.truth;
      break;
    }
    event.isRight = verdict.state == Verdict::State::kRight;
    event.after = verdict.seconds;
    event.travelled = verdict.travelled;
    if (event.isRight) event.readings = splice.readings(robot, beginnings[i], verdict.stamp + 1);
    events.push_back(event);
  }
  return events;
}

/// Runs MCL over a source, and evaluates it.
class Run {
 public:
  Run(const EvalSettings& settings, const LocalizationArguments& arguments,
      Localization& localization)
      : arguments_(arguments),
        localization_(localization),
        evaluation_(localization, settings.options) {}

  /// @param isDone called every few seconds of the log; returns true to end
  void toTheEnd(const std::function<bool(const Evaluation&)>& isDone,
                const std::function<void(double)>& progress) {
    const auto look = [this](const Feeder& feeder) { onMoment(feeder); };
    while (const std::optional<EvaluationStep> step = nextStep(localization_, arguments_, look)) {
      evaluation_.addStep(*step);
      if (arguments_.besideGrid) compareWithGrid();
      if (progress) progress(localization_.feeder().progress());
      if (!isDone || step->estimate.stamp < nextVerdict_) continue;
      nextVerdict_ = step->estimate.stamp + kBetweenVerdicts;
      if (isDone(evaluation_.evaluation())) break;
    }
    static_cast<EvaluatedRun&>(result_) = std::move(evaluation_).result(arguments_.source);
  }
  RunResult& result() { return result_; }
  /// Passes the readings of all times to a bound. @param bound borrowed
  void setBound(SimulatedBound* bound) { bound_ = bound; }

 private:
  /// Compares MCL with the grid filter if both have taken the same readings.
  void compareWithGrid() {
    const PoseEstimate& ours = localization_.mcl().estimate();
    const PoseEstimate& its = localization_.grid()->estimate();
    if (ours.stamp != its.stamp) return;
    result_.besideGrid.push_back({ours.stamp,
                                  localization_.grid()->divergenceOf(localization_.mcl().samples()),
                                  distance(ours.pose, its.pose)});
  }
  void onMoment(const Feeder& feeder) {
    if (bound_ != nullptr) bound_->look(localization_.container(), feeder.stamp(), feeder.truth());
    evaluation_.addMoment();
  }

  const LocalizationArguments& arguments_;
  Localization& localization_;
  RunEvaluation evaluation_;
  RunResult result_;
  SimulatedBound* bound_ = nullptr;
  Timestamp nextVerdict_ = std::numeric_limits<Timestamp>::min();
};

/// Warns about what makes the figures meaningless.
void warnWithoutErrors(const RunResult& run) {
  if (run.figures.overTime.compared > 0) return;
  warn(run.figures.source +
       " has no ground truth for any time with an estimate (a feature of type "
       "groundTruth), so there are no errors; `ortung localize` gives poses");
}

std::unique_ptr<Source> withFaults(std::unique_ptr<Source> source, const std::vector<Fault>& faults,
                                   const Robot& robot, std::uint64_t seed) {
  if (faults.empty()) return source;
  try {
    return disturbed(std::move(source), faults, robot.container, seed);
  } catch (const FaultError& error) {
    throw UsageError(std::string("--fault: ") + error.what());
  }
}

/// Adds from what a run was made, and by what.
void addOrigin(RunResult& result, const EvalSettings& settings, const EvalJob& job,
               const LocalizationArguments& arguments, const Localization& localization) {
  result.kind = job.kind;
  result.number = job.number;
  result.seed = job.seed;
  result.particles = localization.mclConfig().maxSamples;
  result.robot = arguments.robot.string();
  result.tables = arguments.tables.string();
  result.tableInfo = localization.robot().tables;
  result.changes = localization.mcl().mapChanges();
  result.start = arguments.start;
  result.faults = settings.arguments.faults;
  result.commandLine = settings.arguments.commandLine;
}

/// Takes away what a clock has measured.
void forgetTimes(RunResult& run) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  run.updateMs.clear();
  EvaluationResult& figures = run.figures;
  figures.updateMsP50 = figures.updateMsP99 = figures.updateMsMax = figures.realtimeFactor = kNan;
}

/// Returns a run without what summaries do not need.
RunResult lightened(RunResult run) {
  if (run.figures.convergedAfter) {
    const Timestamp since = run.first + fromSeconds(*run.figures.convergedAfter);
    for (const EvaluationPoint& p : run.figures.points)
      if (p.stamp >= since) run.errors.push_back(static_cast<float>(p.positionError));
  }
  run.figures.points = {};
  run.estimates = {};
  run.path = {};
  run.bounds = {};
  run.tableInfo.region = {};
  run.tableInfo.robotToml = {};
  return run;
}

}  // namespace

std::shared_ptr<const Recording> SharedRecording::get() {
  const std::lock_guard lock(mutex_);
  if (recording_) return recording_;
  const std::unique_ptr<Robot> robot = openRobot(robot_);
  const std::unique_ptr<Source> source = openSourceArgument(source_, robot_, robot->factory);
  return recording_ = std::make_shared<Recording>(source_, *source);
}

RunResult runJob(const EvalSettings& settings, const EvalJob& job, const EvalExtras& extras) {
  LocalizationArguments arguments = settings.arguments.localization;
  arguments.source = job.source;
  arguments.seed = job.seed;
  if (job.kind == RunKind::kKidnap || job.kind == RunKind::kTeleports) arguments.start = "truth";
  if (job.kind == RunKind::kWakeUp) arguments.start = "global";
  const std::shared_ptr<const Splice> splice = spliceOf(settings, job);
  const std::unique_ptr<Localization> localization =
      openLocalization(arguments, job.warns, [&](Robot& robot) {
        std::unique_ptr<Source> source =
            splice ? play(splice, robot.container)
                   : openSourceArgument(job.source, arguments.robot, robot.factory);
        return withFaults(std::move(source), settings.faults, robot, job.seed);
      });
  std::unique_ptr<RecordWriter> record;
  if (extras.record) record = extras.record(*localization);
  if (record) localization->feeder().recordInto(*record);

  Run run(settings, arguments, *localization);
  std::function<bool(const Evaluation&)> isDone;
  if (job.kind == RunKind::kKidnap || job.kind == RunKind::kWakeUp) {
    const Timestamp since = beginningsOf(*splice, job.kind).front();
    isDone = [&settings, &job, since](const Evaluation& evaluation) {
      const auto points = evaluation.points();
      return judge(points, since, kEnd, ruleOf(settings, job.kind)).state != Verdict::State::kOpen;
    };
  }
  std::optional<SimulatedBound> bound;
  if (!settings.arguments.bound.empty()) {
    bound.emplace(settings.arguments.bound, arguments.robot);
    run.setBound(&*bound);
  }
  run.toTheEnd(isDone, extras.progress);
  RunResult& result = run.result();
  if (bound) result.bounds = bound->bounds();
  if (bound && result.figures.convergedAfter)
    result.bound =
        figuresOf(result.bounds, result.first + fromSeconds(*result.figures.convergedAfter));
  if (splice)
    result.events =
        eventsOf(settings, job, *splice, localization->container(), result.figures.points);
  addOrigin(result, settings, job, arguments, *localization);
  if (job.warns) {
    warnOf(job.source, localization->source(), localization->feeder());
    warnWithoutOdometry(*localization, arguments);
  }
  requireUpdates(result.figures.steps, arguments);
  if (job.warns) warnWithoutErrors(result);
  if (record) record->commit();
  if (settings.arguments.timesNothing) forgetTimes(result);
  return std::move(result);
}

std::vector<RunResult> runJobs(const EvalSettings& settings, std::vector<EvalJob> jobs,
                               unsigned threads, const std::function<void(std::size_t)>& done) {
  EvalArguments alone = settings.arguments;
  alone.localization.threads = 1;
  const EvalSettings single{alone, settings.options, settings.faults};
  std::vector<RunResult> results(jobs.size());
  std::vector<std::exception_ptr> failures(jobs.size());
  std::atomic<std::size_t> next = 0;
  std::atomic<bool> isOver = false;
  std::mutex mutex;
  std::size_t finished = 0;
  const auto work = [&]() noexcept {
    for (std::size_t i = next++; i < jobs.size() && !isOver; i = next++) {
      try {
        results[i] = lightened(runJob(single, jobs[i]));
        jobs[i].recording.reset();  // a recording is freed after its last job
        const std::lock_guard lock(mutex);
        done(++finished);
      } catch (...) {
        failures[i] = std::current_exception();
        isOver = true;
      }
    }
  };
  {
    std::vector<std::jthread> others;
    for (unsigned t = 1; t < threads; ++t) others.emplace_back(work);
    work();
  }
  for (const std::exception_ptr& failure : failures)
    if (failure) std::rethrow_exception(failure);
  return results;
}

}  // namespace ortung::app

#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "Eval.hpp"
#include "RunResult.hpp"
#include "ortung/records/RecordWriter.hpp"
#include "ortung/run/Localization.hpp"
#include "ortung/study/Evaluation.hpp"
#include "ortung/study/Fault.hpp"
#include "ortung/study/Recording.hpp"

namespace ortung::app {

/// A source's readings in memory, read when they are first needed. Thread-safe.
class SharedRecording {
 public:
  SharedRecording(std::string source, std::filesystem::path robot)
      : source_(std::move(source)), robot_(std::move(robot)) {}
  /// Returns the readings. @throws what Recording and the source throw
  std::shared_ptr<const Recording> get();

 private:
  std::string source_;
  std::filesystem::path robot_;
  std::mutex mutex_;
  std::shared_ptr<const Recording> recording_;
};

/// A run of eval: a source as it is, or a case that is made from it.
struct EvalJob {
  std::string source;
  std::uint64_t seed = 1;
  RunKind kind = RunKind::kWhole;
  std::size_t number = 1;                      ///< number among the runs of its kind, from 1
  std::shared_ptr<SharedRecording> recording;  ///< readings of a case
  bool warns = true;  ///< whether to print warnings about source and tables
};

/// Settings of all runs of a command.
struct EvalSettings {
  const EvalArguments& arguments;
  Evaluation::Options options;
  std::vector<Fault> faults;
};

/// Functions of a single run.
struct EvalExtras {
  std::function<void(double)> progress;  ///< gets the share that is done
  std::function<std::unique_ptr<RecordWriter>(Localization&)> record;  ///< opens a record
};

/// Runs MCL over the source, or until the result of a case is known.
/// @throws UsageError, Interrupted, std::runtime_error
RunResult runJob(const EvalSettings& settings, const EvalJob& job, const EvalExtras& extras = {});

/// Runs all jobs on @p threads threads, each with one thread of MCL, and keeps the figures of each.
/// The result does not depend on the number of threads. An exception of one run ends all.
/// @param done called after each run, one at a time, with the number of finished runs
std::vector<RunResult> runJobs(const EvalSettings& settings, std::vector<EvalJob> jobs,
                               unsigned threads, const std::function<void(std::size_t)>& done);

}  // namespace ortung::app

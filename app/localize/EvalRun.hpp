#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "Eval.hpp"
#include "RunResult.hpp"
#include "ortung/study/Evaluation.hpp"
#include "ortung/records/RecordWriter.hpp"
#include "ortung/study/Fault.hpp"
#include "ortung/study/Recording.hpp"

namespace ortung::app {

/// A source's readings in memory, once somebody needs them. Thread-safe.
class SharedRecording {
 public:
  SharedRecording(std::string source, std::filesystem::path robot)
      : source_(std::move(source)), robot_(std::move(robot)) {}
  /// @throws as Recording, and of the source
  std::shared_ptr<const Recording> get();

 private:
  std::string source_;
  std::filesystem::path robot_;
  std::mutex mutex_;
  std::shared_ptr<const Recording> recording_;
};

/// One run of eval: a source as it is, or a case that is made of it.
struct EvalJob {
  std::string source;
  std::uint64_t seed = 1;
  RunKind kind = RunKind::kWhole;
  std::size_t number = 1;                      ///< of its kind, from 1
  std::shared_ptr<SharedRecording> recording;  ///< of a case
  bool warns = true;  ///< it says what there is to say of source and tables
};

/// What all runs of one command have in common.
struct EvalSettings {
  const EvalArguments& arguments;
  Evaluation::Options options;
  std::vector<Fault> faults;
};

/// What only a run by itself has.
struct EvalExtras {
  std::function<void(double)> progress;                                ///< is told its share
  std::function<std::unique_ptr<RecordWriter>(const Source&)> record;  ///< of all readings
};

/// Runs MCL over the source, or until what the case asks is known.
/// @throws UsageError, Interrupted, std::runtime_error
RunResult runJob(const EvalSettings& settings, const EvalJob& job, const EvalExtras& extras = {});

/// Runs them on so many threads, each with one thread of MCL, and keeps of each what is counted.
/// The result does not depend on the number of threads. What one throws ends all.
/// @param done is called after each, one at a time, with how many are done
std::vector<RunResult> runJobs(const EvalSettings& settings, std::vector<EvalJob> jobs,
                               unsigned threads, const std::function<void(std::size_t)>& done);

}  // namespace ortung::app

#pragma once

#include <string>
#include <vector>

#include "RunResult.hpp"

namespace ortung::app {

/// A run as summaries of many need it. It can be written into a file and read again without a loss,
/// so that summaries do not depend on where the runs were made.
struct KeptRun {
  std::string figures;          ///< the run as a JSON object: toJson(RunResult)
  std::vector<float> errors;    ///< RunResult::errors [m]
  std::vector<float> updateMs;  ///< RunResult::updateMs [ms]
};

KeptRun keptOf(const RunResult& run);

/// Returns many runs as a JSON object: a summary for each source and kind, and all runs.
/// @throws std::runtime_error if the figures of a run are not those of toJson(RunResult)
std::string toJson(const std::vector<KeptRun>& runs);
std::string toJson(const std::vector<RunResult>& runs);

/// Returns their summaries and lists of cases as lines for users. @throws as toJson()
std::string toText(const std::vector<KeptRun>& runs);
std::string toText(const std::vector<RunResult>& runs);

}  // namespace ortung::app

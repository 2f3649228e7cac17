#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "ManyRuns.hpp"
#include "PartSet.hpp"

namespace ortung::app {

inline constexpr const char* kEvalParts = "eval";  ///< kind of the parts

/// Some runs of an evaluation.
struct EvalPart {
  std::vector<std::size_t> numbers;  ///< number of each among all runs, from 0
  std::vector<KeptRun> runs;
};

void write(const EvalPart& part, PartHead head, const std::filesystem::path& file);

/// Returns the runs of all parts in the order in which one process makes them. @throws PartError
std::vector<KeptRun> mergeEvaluated(const PartSet& parts);

/// Returns the JSON that `ortung eval` writes of runs: a single one that is no case has no summary.
std::string figuresOf(const std::vector<KeptRun>& runs);

}  // namespace ortung::app

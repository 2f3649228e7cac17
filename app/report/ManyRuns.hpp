#pragma once

#include <string>
#include <vector>

#include "RunResult.hpp"

namespace ortung::app {

/// Returns many runs as a JSON object: a summary for each source and kind, and all runs.
std::string toJson(const std::vector<RunResult>& runs);

/// Returns their summaries and lists of cases as lines for users.
std::string toText(const std::vector<RunResult>& runs);

}  // namespace ortung::app

#pragma once

#include <string>
#include <vector>

#include "RunResult.hpp"

namespace ortung::app {

/// Many runs as a JSON object for machines: a summary for each source and kind, and all runs.
std::string toJson(const std::vector<RunResult>& runs);

/// Their summaries and lists of cases as lines for people.
std::string toText(const std::vector<RunResult>& runs);

}  // namespace ortung::app

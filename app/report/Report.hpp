#pragma once

#include <string>
#include <string_view>

#include "RunResult.hpp"

namespace ortung::app {

/// Returns a self-contained HTML page with map, paths, charts and figures; it needs no network.
std::string toHtml(const RunResult& run);

/// Returns the map with both paths, as inline SVG.
std::string mapSvg(const RunResult& run);

/// Returns the longest time [s] over which the estimate's path is drawn. If the ground truth is
/// sparse, its times are used, since the median step between estimates may be much shorter.
double longestPathStep(const RunResult& run);

/// Escapes @p text as HTML text or attribute value.
std::string escapeHtml(std::string_view text);

}  // namespace ortung::app

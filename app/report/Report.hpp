#pragma once

#include <string>
#include <string_view>

#include "RunResult.hpp"

namespace ortung::app {

/// One self-contained HTML page with map, paths, charts and figures; it needs no network.
std::string toHtml(const RunResult& run);

/// The map with both paths, as inline SVG.
std::string mapSvg(const RunResult& run);

/// The longest time [s] over which the estimate's path is drawn. Where the truth is rare, moments
/// lie close together here and there, and are joined as the truth is.
double longestPathStep(const RunResult& run);

/// @p text as HTML text or attribute value.
std::string escapeHtml(std::string_view text);

}  // namespace ortung::app

#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

namespace ortung::app {

/// Returns the figure at a path like "at_corrections.nees_mean"; a list's entries are numbered from
/// 0, "summary.0.right.share". Flags are 1 or 0.
/// @returns NaN for a figure that is not known (null); nothing if the path names no figure
std::optional<double> figureAt(const nlohmann::ordered_json& json, const std::string& path);

/// Returns the paths of all figures in their order, at most @p most.
std::vector<std::string> figuresIn(const nlohmann::ordered_json& json, std::size_t most);

/// Says that there is no such figure, which one was meant, and some of those that there are.
/// @param there paths of figures that there are
std::string noFigure(const std::string& path, const std::vector<std::string>& there);

}  // namespace ortung::app

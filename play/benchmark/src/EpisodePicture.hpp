#pragma once

#include <string>
#include <vector>

#include "ortung/base/Export.hpp"
#include "ortung/benchmark/GoalEpisodes.hpp"

namespace ortung {

/// Draws an episode to scale as SVG: the field's end with its goal, and the paths of ball, keeper
/// and striker. Colours are defined by the page.
ORTUNG_API std::string pictureOf(const std::vector<GoalMoment>& moments, const std::string& title);

}  // namespace ortung

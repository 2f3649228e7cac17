#pragma once

#include <string>
#include <vector>

#include "ortung/benchmark/GoalEpisodes.hpp"

namespace ortung {

/// An episode to scale as SVG: the field's end with its goal, and the ways of ball, keeper and
/// striker. Colours are the page's.
std::string pictureOf(const std::vector<GoalMoment>& moments, const std::string& title);

}  // namespace ortung

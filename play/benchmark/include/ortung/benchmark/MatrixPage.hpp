#pragma once

#include <string>
#include <string_view>

#include "ortung/base/Export.hpp"
#include "ortung/benchmark/GoalMatrix.hpp"

namespace ortung {

/// A page for people, in one file that needs no other: scoring rates, differences, pose errors and
/// ratings with their intervals, and pictures of some episodes of each pair, which are played again
/// for them. @param version of the program
/// @throws what GoalEpisodes::play() throws
ORTUNG_API std::string toHtml(const GoalMatrix& matrix, std::string_view version);

}  // namespace ortung

#pragma once

#include <string>
#include <string_view>

#include "ortung/base/Export.hpp"
#include "ortung/benchmark/GoalMatrix.hpp"

namespace ortung {

/// Writes a self-contained HTML page: scoring rates, differences, pose errors and ratings with
/// their intervals, and pictures of some episodes of each pair, which are played again for them.
/// @param version the program's version
/// @throws what GoalEpisodes::play() throws
ORTUNG_API std::string toHtml(const GoalMatrix& matrix, std::string_view version);

}  // namespace ortung

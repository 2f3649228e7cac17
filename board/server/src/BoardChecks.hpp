#pragma once

#include "ortung/server/MessageBoard.hpp"

namespace ortung::server {

/// Whether a board can serve @p world like this.
/// @throws std::invalid_argument for what makes no sense, naming what was found and expected
void checkBoard(const BoardConfig& config, const ServedWorld& world);

}  // namespace ortung::server

#pragma once

#include <string_view>

#include "ortung/sim_api/Game.hpp"

namespace ortung::remote {

/// How the game stands, as the server's GAME tells it: "phase=ready restart=kick-off
/// restart_of=blue half=1 clock_s=12.5 blue=0 yellow=1 left=blue" (docs/protocol.md).
/// @throws std::runtime_error for what is none
Game parseGame(std::string_view text);

}  // namespace ortung::remote

#pragma once

#include <vector>

#include "ortung/base/Export.hpp"
#include "ortung/served/ServedSimulation.hpp"
#include "ortung/server/BoardCommand.hpp"

namespace ortung {

/// PLAY, STOP and PLAYERS: clients start, stop and list the players of a served simulation;
/// REFEREE gives orders to its referee, and GAME returns the state of the game.
/// @param simulation borrowed
ORTUNG_API std::vector<BoardCommand> playerCommands(ServedSimulation& simulation);

}  // namespace ortung

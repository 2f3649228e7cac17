#pragma once

#include <vector>

#include "ortung/base/Export.hpp"
#include "ortung/served/ServedSimulation.hpp"
#include "ortung/server/BoardCommand.hpp"

namespace ortung {

/// PLAY, STOP and PLAYERS: clients start, stop and list the players of a served simulation;
/// REFEREE and GAME: what its referee is told, and what he says.
/// @param simulation borrowed
ORTUNG_API std::vector<BoardCommand> playerCommands(ServedSimulation& simulation);

}  // namespace ortung

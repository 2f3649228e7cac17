#pragma once

#include <vector>

#include "ortung/served/ServedSimulation.hpp"
#include "ortung/server/BoardCommand.hpp"

namespace ortung::app {

/// PLAY, STOP and PLAYERS: clients start, stop and list the players of a served simulation.
/// @param simulation borrowed
std::vector<BoardCommand> playerCommands(ServedSimulation& simulation);

}  // namespace ortung::app

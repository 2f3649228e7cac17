#pragma once

#include <cstddef>
#include <limits>
#include <vector>

#include "ortung/base/Export.hpp"
#include "ortung/served/ServedSimulation.hpp"
#include "ortung/server/BoardCommand.hpp"

namespace ortung {

/// What players that clients start may cost. PLAY is refused beyond it.
struct PlayLimits {
  std::size_t robots = Scene::kMostRobots;  ///< on the field at a time, whoever's they are
  /// Processor time of a cycle, as a share of the time that it simulates, above which nobody else
  /// is let in; so a world that is to keep up with real time does.
  double load = std::numeric_limits<double>::infinity();
};

/// PLAY, STOP and PLAYERS: clients start, stop and list the players of a served simulation;
/// REFEREE gives orders to its referee, and GAME returns the state of the game.
/// @param simulation borrowed
ORTUNG_API std::vector<BoardCommand> playerCommands(ServedSimulation& simulation,
                                                    const PlayLimits& limits = {});

}  // namespace ortung

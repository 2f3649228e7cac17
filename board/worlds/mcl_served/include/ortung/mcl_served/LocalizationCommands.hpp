#pragma once

#include <vector>

#include "ortung/base/Export.hpp"
#include "ortung/mcl_served/LocalizedRobots.hpp"
#include "ortung/server/BoardCommand.hpp"

namespace ortung {

/// HEATMAP and WHY of docs/protocol.md: clients ask how probable a robot's readings are all over
/// the field, by the code with which MCL weighs; and why, at one pose.
/// @param robots borrowed, for as long as the board that has the commands
ORTUNG_API std::vector<BoardCommand> perceptionCommands(const PerceivingRobots& robots);

/// LOCALIZE, and these: clients also switch localizations on and off and give them poses of robots.
/// @param robots borrowed, for as long as the board that has the commands
ORTUNG_API std::vector<BoardCommand> localizationCommands(LocalizedRobots& robots);

}  // namespace ortung

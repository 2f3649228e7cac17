#pragma once

#include "ortung/sim/SimRobot.hpp"
#include "ortung/sim/Simulation.hpp"

namespace ortung {

/// Returns the distance of a thing's middle from the robot's nearest piece, its manipulators
/// included [m]; 0 or less inside of one.
double distanceToPieces(const SimRobot& robot, const Simulation::Thing& thing);

}  // namespace ortung

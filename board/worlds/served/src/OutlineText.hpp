#pragma once

#include <string>
#include <vector>

#include "ortung/sim/RobotShape.hpp"
#include "ortung/sim/Solids.hpp"

namespace ortung {

/// "outline ..." of each piece that a robot may have, as DESCRIBE robot gives it
/// (docs/protocol.md).
std::vector<std::string> outlineText(const RobotShape& shape);
/// "solid ..." of each fixed piece that is no wall and no side of a goal, as DESCRIBE field gives
/// it.
std::vector<std::string> solidText(const Solids& solids);

}  // namespace ortung

#pragma once

#include <string>
#include <vector>

#include "ortung/sim/RobotShape.hpp"

namespace ortung {

/// "outline ..." of each piece that a robot may have, as DESCRIBE robot gives it
/// (docs/protocol.md).
std::vector<std::string> outlineText(const RobotShape& shape);

}  // namespace ortung

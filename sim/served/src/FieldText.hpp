#pragma once

#include <string>
#include <vector>

#include "ortung/sim/RobotShape.hpp"
#include "ortung/sim_api/World.hpp"

namespace ortung {

/// " key=number", the shortest that gives the same number again.
std::string keyValue(const char* key, double number);

/// What stands and is painted on the field, as DESCRIBE field gives it (docs/protocol.md): of walls
/// the longest, at most 20,000.
std::vector<std::string> fieldText(const World& world);

/// "outline ..." of each piece that a robot may have, as DESCRIBE robot gives it.
std::vector<std::string> outlineText(const RobotShape& shape);

}  // namespace ortung

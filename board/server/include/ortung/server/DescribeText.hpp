#pragma once

#include <span>
#include <string>
#include <vector>

#include "ortung/base/Export.hpp"
#include "ortung/server/ServedWorld.hpp"

namespace ortung {

// What DESCRIBE answers, line by line (docs/protocol.md), for programs that show it in another way.

/// The lines of DESCRIBE world: name, kind, bounds and objects.
ORTUNG_API std::vector<std::string> worldText(const WorldDescription& world);

/// @param abilities as of ServedWorld::abilities()
/// The lines of DESCRIBE robot: its features and abilities.
ORTUNG_API std::vector<std::string> robotText(std::span<const ServedFeature> features,
                                              std::span<const std::string> abilities);

}  // namespace ortung

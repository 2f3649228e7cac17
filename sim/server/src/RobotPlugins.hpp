#pragma once

#include <string>
#include <vector>

#include "ortung/core/PluginFactory.hpp"

namespace ortung {

/// Names of all plugins that a robot can be made of, in the order of the alphabet. Loads them, so
/// that no client's robot makes the world wait for the disk. @throws PluginError if there are none
std::vector<std::string> robotPlugins(PluginFactory& factory);

}  // namespace ortung

#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "ortung/base/Export.hpp"
#include "ortung/core/PluginFactory.hpp"

namespace ortung {

/// Names of the plugins that strangers may put into a robot file, in the order of the alphabet:
/// what is offered under one of @p interfaces and nothing else, so that a kind of plugin that is
/// invented later is not theirs before somebody says so. Loads all libraries of such plugins, so
/// that no client's robot makes the world wait for the disk, and no others: those of devices may
/// need hundreds of libraries. Not thread-safe, as the factory is not.
/// @param interfaces as their classes say: SensorData::kInterface, ...
/// @throws PluginError if there are none
ORTUNG_API std::vector<std::string> robotPlugins(PluginFactory& factory,
                                                 std::span<const std::string_view> interfaces);

/// Names of all plugins of some interfaces, in the order of the alphabet. Loads their libraries.
ORTUNG_API std::vector<std::string> pluginsOf(PluginFactory& factory,
                                              std::span<const std::string_view> interfaces);

}  // namespace ortung

#include "ortung/server/RobotPlugins.hpp"

#include <algorithm>
#include <set>

namespace ortung {

std::vector<std::string> robotPlugins(PluginFactory& factory,
                                      std::span<const std::string_view> interfaces) {
  std::set<std::string> names;
  for (const PluginFactory::Found& library : factory.list())
    for (const PluginFactory::Found::Entry& entry : library.entries)
      if (std::find(interfaces.begin(), interfaces.end(), entry.interface) != interfaces.end())
        names.insert(entry.name);
  if (names.empty())
    throw PluginError(
        "no plugin that robots are made of could be loaded; `ortung plugins` says why");
  return {names.begin(), names.end()};
}

}  // namespace ortung

#include "RobotPlugins.hpp"

#include <set>

namespace ortung {

std::vector<std::string> robotPlugins(PluginFactory& factory) {
  std::set<std::string> names;
  for (const PluginFactory::Found& library : factory.list())
    for (const PluginFactory::Found::Entry& entry : library.entries) {
      // Sources read files and players belong to whoever runs the server.
      const bool isOfRobot = !entry.interface.starts_with("ortung.Source/") &&
                             !entry.interface.starts_with("ortung.Player/");
      if (isOfRobot) names.insert(entry.name);
    }
  if (names.empty())
    throw PluginError(
        "no plugin that robots are made of could be loaded; `ortung plugins` says why");
  return {names.begin(), names.end()};
}

}  // namespace ortung

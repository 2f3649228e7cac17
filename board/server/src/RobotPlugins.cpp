#include "ortung/server/RobotPlugins.hpp"

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>

namespace ortung {
namespace {

/// Whether a library may offer a plugin of one of the interfaces: then their names are in it.
bool mentions(const std::filesystem::path& library, std::span<const std::string_view> interfaces) {
  std::error_code error;
  const std::uintmax_t size = std::filesystem::file_size(library, error);
  std::string content(error ? 0 : size, '\0');
  std::ifstream(library, std::ios::binary).read(content.data(), std::ssize(content));
  return std::any_of(interfaces.begin(), interfaces.end(), [&](std::string_view interface) {
    return ::memmem(content.data(), content.size(), interface.data(), interface.size()) != nullptr;
  });
}

}  // namespace

std::vector<std::string> pluginsOf(PluginFactory& factory,
                                   std::span<const std::string_view> interfaces) {
  std::set<std::string> names;
  for (const std::filesystem::path& library : factory.libraries()) {
    if (!mentions(library, interfaces)) continue;
    for (const PluginFactory::Found::Entry& entry : factory.look(library).entries)
      if (std::find(interfaces.begin(), interfaces.end(), entry.interface) != interfaces.end())
        names.insert(entry.name);
  }
  return {names.begin(), names.end()};
}

std::vector<std::string> robotPlugins(PluginFactory& factory,
                                      std::span<const std::string_view> interfaces) {
  std::vector<std::string> names = pluginsOf(factory, interfaces);
  if (names.empty())
    throw PluginError(
        "no plugin that robots are made of could be loaded; `ortung plugins` says why");
  return names;
}

}  // namespace ortung

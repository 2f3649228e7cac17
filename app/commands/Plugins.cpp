#include <fmt/format.h>

#include "Commands.hpp"
#include "Console.hpp"
#include "ortung/core/PluginFactory.hpp"

namespace ortung::app {
namespace {

/// "ortung.Source/0.1.0-3f2a" is a Source.
std::string kindOf(const std::string& interface) {
  const std::size_t begin = interface.starts_with("ortung.") ? 7 : 0;
  return interface.substr(begin, interface.find('/', begin) - begin);
}

void print(const PluginFactory::Found& found) {
  if (!found.error.empty()) {
    fmt::print("{}\n  BROKEN: {}\n", printable(found.file.string()), printable(found.error));
    return;
  }
  fmt::print("{}\n  library {}, version {}\n", printable(found.file.string()),
             printable(found.library), printable(found.version));
  for (const auto& entry : found.entries) {
    fmt::print("  {:<12} {}\n", printable(kindOf(entry.interface)), printable(entry.name));
  }
}

}  // namespace

int runPlugins() {
  const std::vector<std::filesystem::path> folders = PluginFactory::standardFolders();
  const std::vector<PluginFactory::Found> found = PluginFactory(folders).list();
  std::size_t broken = 0;
  for (const PluginFactory::Found& library : found) {
    print(library);
    if (!library.error.empty()) ++broken;
  }
  fmt::print("{} libraries, {} broken; looked in", found.size(), broken);
  for (const auto& folder : folders) fmt::print(" {}", printable(folder.string()));
  fmt::print("\n  Source       record (built in)\n");
  return broken == 0 ? 0 : 1;
}

}  // namespace ortung::app

#pragma once

#include <filesystem>

namespace ortung::app {

struct PluginsArguments {
  double timeout = 10.0;         ///< for a library to load [s]
  std::filesystem::path inside;  ///< set in a process of its own for this library
};
int runPlugins(const PluginsArguments& arguments);

}  // namespace ortung::app

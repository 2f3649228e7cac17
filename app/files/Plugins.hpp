#pragma once

#include <filesystem>

namespace ortung::app {

/// Arguments of `ortung plugins`.
struct PluginsArguments {
  double timeout = 10.0;         ///< greatest time to load a library [s]
  std::filesystem::path inside;  ///< library, in the child process that loads it; else ""
};
int runPlugins(const PluginsArguments& arguments);

}  // namespace ortung::app

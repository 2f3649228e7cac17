#pragma once

#include <filesystem>
#include <string>

namespace ortung::app {

/// Arguments of `ortung plugins`.
struct PluginsArguments {
  std::string kind;              ///< kind to list, as its word says; "": all, by libraries
  std::string name;              ///< plugin of that kind to describe; "": list all
  bool paths = false;            ///< whether the list of a kind names parts and libraries, too
  double timeout = 10.0;         ///< greatest time to load a library [s]
  std::filesystem::path inside;  ///< library, in the child process that loads it; else ""
};
int runPlugins(const PluginsArguments& arguments);

/// Returns the words for the kinds of plugins, for the help: "sensor, motion, ...".
std::string kindsText();

}  // namespace ortung::app

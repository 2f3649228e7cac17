#pragma once

#include <string>

namespace CLI {  // NOLINT(readability-identifier-naming): the library's own
class App;
}  // namespace CLI

namespace ortung::app {

/// Adds the command of this name in the catalogue, e.g. "export map", with its summary, and its
/// group if this is the group's first command.
CLI::App& addCommand(CLI::App& root, const std::string& name);

}  // namespace ortung::app

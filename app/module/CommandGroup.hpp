#pragma once

#include <string>

namespace CLI {
class App;
}  // namespace CLI

namespace ortung::app {

/// Makes the command that the catalogue has by this name, e.g. "export map", with its summary; the
/// group that it belongs to is made when its first command is.
CLI::App& addCommand(CLI::App& root, const std::string& name);

}  // namespace ortung::app

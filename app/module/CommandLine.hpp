#pragma once

#include <functional>
#include <string>
#include <vector>

#include "CommandModule.hpp"

namespace ortung::app {

/// What the command line asks for.
struct ParsedCommand {
  std::string name;          ///< of the command
  std::function<int()> run;  ///< empty: help or an error was printed, end with exitCode
  int exitCode = 0;
  double pluginSeconds = 10.0;  ///< that a plugin may stay in one call [s]; 0: for ever
};

/// @param commands those that there are; another one is an error
ParsedCommand parseCommandLine(const std::vector<CommandDeclaration>& commands, int argc,
                               char** argv);

}  // namespace ortung::app

#pragma once

#include <functional>
#include <string>
#include <vector>

#include "CommandModule.hpp"

namespace ortung::app {

/// A command line that was parsed.
struct ParsedCommand {
  std::string name;             ///< name of the command
  std::function<int()> run;     ///< the command; empty: help or an error was printed, see exitCode
  int exitCode = 0;             ///< exit code if there is nothing to run
  double pluginSeconds = 10.0;  ///< greatest time of a plugin's call [s]; 0: unlimited
};

/// Parses a command line, and prints help and errors.
/// @param commands the commands that exist; another one is an error
ParsedCommand parseCommandLine(const std::vector<CommandDeclaration>& commands, int argc,
                               char** argv);

}  // namespace ortung::app

#pragma once

#include <functional>
#include <string>

namespace ortung::app {

/// What the command line asks for.
struct ParsedCommand {
  std::string name;          ///< of the subcommand
  std::function<int()> run;  ///< empty: help or an error was printed, end with exitCode
  int exitCode = 0;
  double pluginSeconds = 10.0;  ///< that a plugin may stay in one call [s]; 0: for ever
};

ParsedCommand parseCommandLine(int argc, char** argv);

}  // namespace ortung::app

#pragma once

#include <string>
#include <vector>

namespace CLI {  // NOLINT(readability-identifier-naming): the library's own
class App;
class ParseError;
}  // namespace CLI

namespace ortung::app {

/// Prints the help that a command line asks for, or one line that says what is wrong with it (CLI11
/// prints two). An option that the command does not have is named before anything else that is
/// wrong, with the one that was most likely meant.
/// @param words the command line without the program's name
/// @return the program's exit code
int printUsage(const CLI::App& app, const CLI::ParseError& error,
               const std::vector<std::string>& words);

}  // namespace ortung::app

#pragma once

namespace CLI {
class App;
class ParseError;
}  // namespace CLI

namespace ortung::app {

/// Prints the help that a command line asks for, or one line that says what is wrong with it (CLI11
/// prints two). @return the program's exit code
int printUsage(const CLI::App& app, const CLI::ParseError& error);

}  // namespace ortung::app

#pragma once

namespace CLI {
class App;
class ParseError;
}  // namespace CLI

namespace ortung::app {

/// What comes of a command line that runs nothing: the help that it asks for, or one line that says
/// what is wrong (CLI11 has two). @return the program's exit code
int printUsage(const CLI::App& app, const CLI::ParseError& error);

}  // namespace ortung::app

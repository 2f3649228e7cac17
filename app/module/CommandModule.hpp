#pragma once

#include <vector>

namespace ortung::app {

class Builder;

/// Declares one command.
using CommandDeclaration = void (*)(Builder&);

// A command consists of three files in the folder of its kind: Learn.hpp declares its arguments and
// the function that does the work, LearnOptions.cpp declares its options, Learn.cpp does the work.
// The function prints results to stdout and throws errors, which RunCommand.cpp turns into a
// message and an exit code.

/// The interface of a command's module: the program opens it by the command's name, as sensors are
/// opened by theirs. The version comes first, since it decides whether the rest can be used.
struct CommandModule {
  const char* version;  ///< version of program and headers; modules of another one are refused
  /// Parses the command line and runs the command. @return the program's exit code; never throws
  int (*run)(int argc, char** argv);
  /// Prints the module's commands and their options as JSON, for manuals and completion.
  int (*describe)();
};

/// The name of the module's one symbol.
inline constexpr const char* kCommandModuleSymbol = "ortung_command_module";

/// The `run` of all modules: parses, runs, and turns errors into an exit code.
int runCommand(const std::vector<CommandDeclaration>& commands, int argc, char** argv);
/// The `describe` of all modules.
int describeCommands(const std::vector<CommandDeclaration>& commands);
/// Returns the version of this program and of the headers with which it was built.
const char* commandVersion();

}  // namespace ortung::app

/// ORTUNG_COMMAND_MODULE(addLearn) makes a module of the commands that these functions declare.
#define ORTUNG_COMMAND_MODULE(...)                                                                \
  extern "C" __attribute__((visibility("default"))) ortung::app::CommandModule                    \
  ortung_command_module() {                                                                       \
    return {                                                                                      \
        ortung::app::commandVersion(),                                                            \
        [](int argc, char** argv) { return ortung::app::runCommand({__VA_ARGS__}, argc, argv); }, \
        [] { return ortung::app::describeCommands({__VA_ARGS__}); }};                             \
  }

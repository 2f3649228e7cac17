#pragma once

#include <vector>

namespace ortung::app {

class Builder;

/// Declares one command.
using CommandDeclaration = void (*)(Builder&);

// A command is three files of one name in the folder of its kind: Learn.hpp has its arguments and the
// function that does the work, LearnOptions.cpp says what it takes, Learn.cpp does it. The function
// prints results to stdout and throws what went wrong; RunCommand.cpp turns that into a message and
// an exit code.

/// What a command's module shows of itself, and nothing else: the program opens it by the command's
/// name, as sensors are opened by theirs. The version comes first, and tells whether the rest is
/// what it seems.
struct CommandModule {
  const char* version;  ///< of program and headers; modules of another one are refused
  /// Reads the command line and does the work. @return the program's exit code; throws nothing
  int (*run)(int argc, char** argv);
  /// What the module's commands are called and take, as JSON on stdout, for manuals and completion.
  int (*describe)();
};

/// The name of the module's one symbol.
inline constexpr const char* kCommandModuleSymbol = "ortung_command_module";

/// What all modules' `run` does: parses, runs, and makes an exit code of what goes wrong.
int runCommand(const std::vector<CommandDeclaration>& commands, int argc, char** argv);
int describeCommands(const std::vector<CommandDeclaration>& commands);
/// Of this program, and of the headers that it was built with.
const char* commandVersion();

}  // namespace ortung::app

/// ORTUNG_COMMAND_MODULE(addLearn)  makes a module of the commands that these functions declare.
#define ORTUNG_COMMAND_MODULE(...)                                                                \
  extern "C" __attribute__((visibility("default"))) ortung::app::CommandModule                    \
  ortung_command_module() {                                                                       \
    return {                                                                                      \
        ortung::app::commandVersion(),                                                            \
        [](int argc, char** argv) { return ortung::app::runCommand({__VA_ARGS__}, argc, argv); }, \
        [] { return ortung::app::describeCommands({__VA_ARGS__}); }};                             \
  }

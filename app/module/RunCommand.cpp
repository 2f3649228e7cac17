#include <cstdio>
#include <exception>
#include <new>
#include <string>

#include "CommandLine.hpp"
#include "CommandModule.hpp"
#include "Console.hpp"
#include "Interrupt.hpp"
#include "Rescue.hpp"
#include "ortung/base/InstructionSet.hpp"
#include "ortung/core/PluginGuard.hpp"

namespace ortung::app {
namespace {

constexpr int kBadInput = 1;
constexpr int kWrongUsage = 2;
constexpr int kSignalled = 128;

/// Tells of an error, or of that of stdout, which may have caused any other error.
/// @return the exit code
int tell(const std::exception& error) {
  try {
    if (std::ferror(stdout) != 0) flushOutput();
  } catch (const std::exception& output) {
    if (isReaderGone(output)) return kReaderLeft;
    fail(output.what());
    return kBadInput;
  }
  if (isReaderGone(error)) return kReaderLeft;
  fail(error.what());
  return kBadInput;
}

int run(const ParsedCommand& command) {
  if (!command.run) {
    flushOutput();
    return command.exitCode;
  }
  setCommandName("ortung " + command.name);
  catchInterrupts();
  const PluginWatch watch(command.pluginSeconds, [](const std::string& late) {
    Rescue::saveAllAndEnd(late + "; the program ends, see --plugin-seconds", kBadInput);
  });
  const int exitCode = command.run();
  flushOutput();
  return exitCode;
}

}  // namespace

int runCommand(const std::vector<CommandDeclaration>& commands, int argc, char** argv) {
  setCommandName("ortung");
  try {
    checkInstructionSet();
    return run(parseCommandLine(commands, argc, argv));
  } catch (const UsageError& error) {
    fail(error.what());
    return kWrongUsage;
  } catch (const std::bad_alloc&) {
    fail("not enough memory");
  } catch (const std::exception& error) {
    // Work that a signal has stopped may throw different errors.
    if (interruptSignal() == 0) return tell(error);
    fail(Interrupted().what());
  } catch (...) {
    fail("an exception was thrown that is not a std::exception");
  }
  return interruptSignal() != 0 ? kSignalled + interruptSignal() : kBadInput;
}

}  // namespace ortung::app

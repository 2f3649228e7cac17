#include <cstdio>
#include <exception>
#include <new>
#include <string>

#include "CommandLine.hpp"
#include "Console.hpp"
#include "Interrupt.hpp"
#include "Rescue.hpp"
#include "ortung/base/InstructionSet.hpp"
#include "ortung/core/PluginGuard.hpp"

namespace {

constexpr int kBadInput = 1;
constexpr int kWrongUsage = 2;
constexpr int kSignalled = 128;

/// What goes wrong with stdout first shows wherever something is printed.
std::string outputError() {
  if (std::ferror(stdout) == 0) return "";
  try {
    ortung::app::flushOutput();
  } catch (const std::exception& error) {
    return error.what();
  }
  return "";
}

}  // namespace

int main(int argc, char** argv) {
  using namespace ortung::app;
  reserveStandardStreams();
  setCommandName("ortung");
  try {
    ortung::checkInstructionSet();
    const ParsedCommand command = parseCommandLine(argc, argv);
    if (!command.run) {
      flushOutput();
      return command.exitCode;
    }
    setCommandName("ortung " + command.name);
    catchInterrupts();
    const ortung::PluginWatch watch(command.pluginSeconds, [](const std::string& late) {
      Rescue::saveAllAndEnd(late + "; the program ends, see --plugin-seconds");
    });
    const int exitCode = command.run();
    flushOutput();
    return exitCode;
  } catch (const UsageError& error) {
    fail(error.what());
    return kWrongUsage;
  } catch (const std::bad_alloc&) {
    fail("not enough memory");
  } catch (const std::exception& error) {
    // Work that was stopped by a signal may call that by many names.
    const std::string output = outputError();
    const std::string what = output.empty() ? error.what() : output;
    fail(interruptSignal() != 0 ? Interrupted().what() : what);
  } catch (...) {
    fail("something was thrown that is no std::exception");
  }
  return interruptSignal() != 0 ? kSignalled + interruptSignal() : kBadInput;
}

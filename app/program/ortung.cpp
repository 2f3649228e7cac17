#include <fmt/format.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <exception>
#include <set>
#include <string>
#include <vector>

#include "Catalogue.hpp"
#include "CommandGroup.hpp"
#include "Console.hpp"
#include "HelpFormatter.hpp"
#include "ModuleLoader.hpp"
#include "UsageText.hpp"
#include "ortung/base/Nearest.hpp"

// The program itself has only the names of its commands. Modules have their code and load their
// libraries, and only the module of the requested command is opened.

namespace ortung::app {
namespace {

constexpr int kBadInput = 1;
constexpr int kWrongUsage = 2;

/// Returns the command with which the line begins; nullptr if there is none.
const CatalogueEntry* commandOf(int argc, char** argv) {
  const std::string one = argc > 1 ? argv[1] : "";
  const std::string two = argc > 2 ? one + " " + argv[2] : one;
  for (const CatalogueEntry& entry : catalogue())
    if (entry.name == two || entry.name == one) return &entry;
  return nullptr;
}

/// Returns the words with which commands begin.
std::vector<std::string> firstWords() {
  std::vector<std::string> words;
  for (const CatalogueEntry& entry : catalogue()) {
    const std::string name = entry.name;
    words.push_back(name.substr(0, name.find(' ')));
  }
  return words;
}

/// Prints what needs no module: help, the version, or an error.
int answer(int argc, char** argv) {
  CLI::App app("Ortung: learn what sensors see, and localize with it.", "ortung");
  app.formatter(helpFormatter());
  app.set_version_flag("--version", "ortung " ORTUNG_VERSION);
  app.require_subcommand(1);
  app.footer(
      "Example:\n  ortung learn --world maps/fields/f2000.toml --robot maps/robots/pioneer.toml "
      "--out f2000.ortung");
  for (const CatalogueEntry& entry : catalogue()) addCommand(app, entry.name);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    const std::string first = argc > 1 ? argv[1] : "";
    const bool isUnknown = app.get_subcommands().empty() && !first.empty() && first[0] != '-';
    if (!isUnknown) return printUsage(app, error, {argv + 1, argv + argc});
    setCommandName("ortung");
    fail("there is no subcommand '" + first + "'" + didYouMean(first, firstWords()) +
         "; see `ortung --help`");
    return kWrongUsage;
  }
  return kWrongUsage;  // not reached: a command would have been found before
}

/// Prints all installed commands, a line of JSON for each.
int describeAll() {
  std::set<std::string> done;
  for (const CatalogueEntry& entry : catalogue())
    if (isInstalled(entry) && done.insert(entry.module).second) loadModule(entry).describe();
  return 0;
}

int runProgram(int argc, char** argv) {
  setCommandName("ortung");
  try {
    if (argc == 2 && std::string(argv[1]) == "--describe") return describeAll();
    if (const CatalogueEntry* command = commandOf(argc, argv))
      return loadModule(*command).run(argc, argv);
    const int exitCode = answer(argc, argv);
    flushOutput();
    return exitCode;
  } catch (const std::exception& error) {
    if (isReaderGone(error)) return kReaderLeft;
    fail(error.what());
    return kBadInput;
  }
}

}  // namespace
}  // namespace ortung::app

int main(int argc, char** argv) {
  ortung::app::reserveStandardStreams();
  return ortung::app::runProgram(argc, argv);
}

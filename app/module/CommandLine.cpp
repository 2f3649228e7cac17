#include "CommandLine.hpp"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#include "Console.hpp"
#include "HelpFormatter.hpp"
#include "OptionBuilder.hpp"
#include "UsageText.hpp"

namespace ortung::app {
namespace {

std::string quoted(const std::string& word) {
  const bool plain =
      !word.empty() &&
      word.find_first_not_of(
          "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-./:,=+@%") ==
          std::string::npos;
  if (plain) return word;
  std::string text = "'";
  for (const char c : word) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return text + "'";
}

}  // namespace

ParsedCommand parseCommandLine(const std::vector<CommandDeclaration>& commands, int argc,
                               char** argv) {
  ParsedCommand parsed;
  std::string commandLine = "ortung";
  for (int i = 1; i < argc; ++i) commandLine += " " + quoted(argv[i]);

  CLI::App app("", "ortung");
  app.formatter(helpFormatter());
  app.require_subcommand(1);
  Builder build(app, parsed, commandLine);
  for (const CommandDeclaration declare : commands) declare(build);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    parsed.run = nullptr;
    parsed.exitCode = printUsage(app, error, {argv + std::min(argc, 1), argv + argc});
  }
  return parsed;
}

}  // namespace ortung::app

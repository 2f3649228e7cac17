#include "UsageText.hpp"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <optional>

#include "Console.hpp"
#include "ortung/base/Nearest.hpp"

namespace ortung::app {
namespace {

/// Returns the options that are shown of a command.
std::vector<std::string> optionsOf(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::Option* option : command.get_options()) {
    if (option->get_group().empty()) continue;
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  }
  return names;
}

/// Returns the first word that looks like an option and is none of the command.
std::optional<std::string> unknownOption(const CLI::App& command,
                                         const std::vector<std::string>& words) {
  for (const std::string& word : words) {
    if (word == "--") break;
    if (!word.starts_with("--")) continue;
    std::string name = word.substr(0, word.find('='));
    if (command.get_option_no_throw(name) == nullptr) return name;
  }
  return std::nullopt;
}

}  // namespace

int printUsage(const CLI::App& app, const CLI::ParseError& error,
               const std::vector<std::string>& words) {
  constexpr int kWrongUsage = 2;
  if (error.get_exit_code() == static_cast<int>(CLI::ExitCodes::Success)) return app.exit(error);
  std::string name = "ortung";
  const CLI::App* command = &app;
  while (!command->get_subcommands().empty()) {
    command = command->get_subcommands().front();
    name += " " + command->get_name();
  }
  setCommandName(name);
  std::string what = error.what();
  if (const auto unknown = unknownOption(*command, words))
    what = "there is no option " + *unknown + didYouMean(*unknown, optionsOf(*command));
  fail(what + "; see `" + name + " --help`");
  return kWrongUsage;
}

}  // namespace ortung::app

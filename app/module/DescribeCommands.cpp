#include <fmt/format.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <nlohmann/json.hpp>

#include "CommandModule.hpp"
#include "OptionBuilder.hpp"

namespace ortung::app {
namespace {

using Json = nlohmann::ordered_json;

Json describe(const CLI::Option& option) {
  Json names = Json::array();
  for (const std::string& name : option.get_snames()) names.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) names.push_back("--" + name);
  const bool isFlag = option.get_items_expected_max() == 0;
  Json json = {{"names", names},
               {"positional", option.get_name(true)},
               {"help", option.get_description()},
               {"required", option.get_required()},
               {"many", option.get_items_expected_max() > 1 ||
                            option.get_multi_option_policy() == CLI::MultiOptionPolicy::TakeAll},
               {"flag", isFlag}};
  if (!names.empty()) json.erase("positional");
  if (!option.get_default_str().empty()) json["default"] = option.get_default_str();
  // CLI11 has the words of a choice in its check only, as {a,b}.
  const std::string check = option.get_type_name();
  if (const auto open = check.find(":{"); open != check.npos && check.ends_with('}')) {
    Json choices = Json::array();
    std::size_t at = open + 2;
    while (at < check.size()) {
      const std::size_t end = check.find_first_of(",}", at);
      choices.push_back(check.substr(at, end - at));
      at = end + 1;
    }
    json["choices"] = choices;
  }
  return json;
}

void print(const CLI::App& app, const std::string& name) {
  const auto isCommand = [](const CLI::App*) { return true; };
  const auto commands = app.get_subcommands(isCommand);
  for (const CLI::App* command : commands) print(*command, name + " " + command->get_name());
  if (!commands.empty()) return;
  Json options = Json::array();
  for (const CLI::Option* option : app.get_options())
    if (!option->get_group().empty()) options.push_back(describe(*option));
  const Json json = {{"name", name},
                     {"summary", app.get_description()},
                     {"options", options},
                     {"footer", app.get_footer()}};
  fmt::print("{}\n", json.dump());
}

}  // namespace

int describeCommands(const std::vector<CommandDeclaration>& commands) {
  ParsedCommand parsed;
  CLI::App app("", "ortung");
  Builder build(app, parsed, "ortung");
  for (const CommandDeclaration declare : commands) declare(build);
  print(app, "ortung");
  return 0;
}

}  // namespace ortung::app

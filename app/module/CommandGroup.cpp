#include "CommandGroup.hpp"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#include "Catalogue.hpp"

namespace ortung::app {
namespace {

CLI::App& groupOf(CLI::App& root, const std::string& word) {
  const auto isIt = [&](const CLI::App* app) { return app->get_name() == word; };
  for (CLI::App* there : root.get_subcommands(isIt)) return *there;
  const CatalogueGroup& group = groupNamed(word);
  CLI::App* made = root.add_subcommand(word, group.summary);
  made->require_subcommand(1);
  made->footer(std::string("Example:\n  ") + group.example);
  return *made;
}

}  // namespace

CLI::App& addCommand(CLI::App& root, const std::string& name) {
  const std::size_t blank = name.find(' ');
  CLI::App& parent = blank == name.npos ? root : groupOf(root, name.substr(0, blank));
  return *parent.add_subcommand(name.substr(blank + 1), commandNamed(name).summary);
}

}  // namespace ortung::app

#include "CommandGroup.hpp"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#include "Catalogue.hpp"

namespace ortung::app {
namespace {

CLI::App& groupOf(CLI::App& root, const std::string& word, const char* section) {
  const auto isIt = [&](const CLI::App* app) { return app->get_name() == word; };
  for (CLI::App* there : root.get_subcommands(isIt)) return *there;
  const CatalogueGroup& group = groupNamed(word);
  CLI::App* made = root.add_subcommand(word, group.summary)->group(section);
  made->require_subcommand(1);
  made->footer(std::string("Example:\n  ") + group.example);
  return *made;
}

}  // namespace

CLI::App& addCommand(CLI::App& root, const std::string& name) {
  const std::size_t blank = name.find(' ');
  const CatalogueEntry& entry = commandNamed(name);
  if (blank == name.npos) return *root.add_subcommand(name, entry.summary)->group(entry.section);
  CLI::App& parent = groupOf(root, name.substr(0, blank), entry.section);
  return *parent.add_subcommand(name.substr(blank + 1), entry.summary)->group("Commands");
}

}  // namespace ortung::app

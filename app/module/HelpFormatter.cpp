#include "HelpFormatter.hpp"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <sstream>
#include <string>

#include "Colours.hpp"

namespace ortung::app {
namespace {

constexpr std::size_t kWidth = 100;  ///< most characters of a line
constexpr std::size_t kColumn = 28;  ///< column where descriptions begin

/// Returns the words of a text in lines that begin at a column, the first one behind @p head.
std::string wrapped(const std::string& head, std::size_t column, const std::string& text) {
  std::string out = head;
  std::size_t at = head.size();
  std::istringstream words(text);
  bool isFirst = true;
  for (std::string word; words >> word; isFirst = false) {
    const bool isFull = !isFirst && at + 1 + word.size() > kWidth;
    if (isFull || (isFirst && at > 0 && at + 2 > column)) {
      out += '\n';
      at = 0;
    }
    const bool isBegin = isFirst || isFull;
    const std::size_t blanks = !isBegin ? 1 : column - at;
    out += std::string(blanks, ' ') + word;
    at += blanks + word.size();
  }
  return out + '\n';
}

class HelpFormatter : public CLI::Formatter {
 public:
  HelpFormatter() {
    label("FLOAT", "NUMBER");
    label("UINT", "N");
  }

  std::string make_help(const CLI::App* app, std::string name,
                        CLI::AppFormatMode mode) const override {
    std::string out;
    if (!app->get_description().empty()) out = wrapped("", 0, app->get_description());
    out += make_usage(app, std::move(name)) + make_positionals(app);
    std::vector<std::string> groups = app->get_groups();
    std::stable_partition(groups.begin(), groups.end(),
                          [](const std::string& group) { return group != kGeneral; });
    for (const std::string& group : groups) {
      const auto isShown = [&](const CLI::Option* option) {
        return option->get_group() == group && option->nonpositional();
      };
      const auto options = app->get_options(isShown);
      if (!group.empty() && !options.empty()) out += make_group(group, false, options);
    }
    return out + make_subcommands(app, mode) + '\n' + make_footer(app);
  }

  std::string make_group(std::string group, bool isPositional,
                         std::vector<const CLI::Option*> options) const override {
    std::string out = '\n' + heading(group + ":") + '\n';
    for (const CLI::Option* option : options) out += make_option(option, isPositional);
    return out;
  }

  std::string make_option(const CLI::Option* option, bool isPositional) const override {
    return wrapped("  " + make_option_name(option, isPositional) + make_option_opts(option),
                   2 + kColumn, make_option_desc(option));
  }

  std::string make_subcommands(const CLI::App* app, CLI::AppFormatMode) const override {
    std::string out, group;
    for (const CLI::App* command : app->get_subcommands({})) {
      if (command->get_group() != group) out += '\n' + heading(command->get_group() + ":") + '\n';
      group = command->get_group();
      out += make_subcommand(command);
    }
    return out;
  }

  std::string make_subcommand(const CLI::App* command) const override {
    return wrapped("  " + command->get_name(), 2 + kColumn, command->get_description());
  }

 private:
  static std::string heading(const std::string& text) { return bold(text, stdout); }
};

}  // namespace

std::shared_ptr<CLI::FormatterBase> helpFormatter() { return std::make_shared<HelpFormatter>(); }

}  // namespace ortung::app

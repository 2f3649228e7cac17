#include "OptionBuilder.hpp"

#include <fmt/format.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>

#include "CommandGroup.hpp"
#include "HelpFormatter.hpp"

namespace ortung::app {
namespace {

/// Checks a finite number within bounds; CLI11's Range accepts NaN.
CLI::Validator withinBounds(double low, double high) {
  const std::string what = fmt::format("a number from {:g} to {:g}", low, high);
  return CLI::Validator(
      [low, high, what](std::string& text) -> std::string {
        double number = 0.0;
        const char* end = text.data() + text.size();
        const auto [behind, error] = std::from_chars(text.data(), end, number);
        const bool fits = error == std::errc() && behind == end && number >= low && number <= high;
        return fits ? "" : fmt::format("is '{}', expected {}", text, what);
      },
      "");
}

/// Whether a result never depends on an option of that name.
bool neverMatters(const std::string& name) {
  static constexpr std::array<std::string_view, 10> kNames = {
      "--threads", "--progress", "--force", "--shard",          "--out",
      "--json",    "--html",     "--help",  "--plugin-seconds", "--view"};
  return std::find(kNames.begin(), kNames.end(), name) != kNames.end();
}

/// Whether all commands mean the same by an option of that name, so that it is listed last.
bool isGeneral(const std::string& name) {
  static constexpr std::array<std::string_view, 3> kNames = {"--threads", "--progress", "--force"};
  return std::find(kNames.begin(), kNames.end(), name) != kNames.end();
}

}  // namespace

Option& Option::required() {
  option_.required();
  return *this;
}
Option& Option::showsDefault() {
  option_.capture_default_str();
  return *this;
}
Option& Option::within(double low, double high) {
  option_.check(withinBounds(low, high));
  return *this;
}
Option& Option::oneOf(const std::vector<std::string>& words) {
  option_.check(CLI::IsMember(words));
  return *this;
}
Option& Option::repeats() {
  option_.expected(1)->take_all();
  return *this;
}
Option& Option::splitsAt(char delimiter) {
  option_.delimiter(delimiter);
  return *this;
}
Option& Option::expects(int least, int most) {
  option_.expected(least, most);
  return *this;
}
Option& Option::hides() {
  option_.group("");
  return *this;
}

Builder::Builder(CLI::App& root, ParsedCommand& parsed, std::string commandLine)
    : root_(root), parsed_(parsed), commandLine_(std::move(commandLine)) {}

void Builder::begin(const std::string& name, const std::string& example, std::function<int()> run) {
  current_ = &addCommand(root_, name);
  afterParsing_ = std::make_shared<std::vector<std::function<void()>>>();
  current_->parse_complete_callback([actions = afterParsing_] {
    for (const auto& action : *actions) action();
  });
  current_->footer("Example:\n  " + example);
  group_ = kGeneral;
  option("--plugin-seconds", parsed_.pluginSeconds,
         "Longest time of a plugin's call, after which the program saves its results and ends "
         "[s]; 0: unlimited")
      .within(0.0, 1e6)
      .showsDefault();
  current_->get_help_ptr()->group(kGeneral);
  group_ = "Options";
  current_->callback([parsed = &parsed_, name, run = std::move(run)] {
    parsed->name = name;
    parsed->run = run;
  });
}

std::string Builder::groupOf(const std::string& name) const {
  return isGeneral(name) ? kGeneral : group_;
}

template <class Value>
Option Builder::option(const std::string& names, Value& value, const std::string& description) {
  return Option(*current_->add_option(names, value, description)->group(groupOf(names)));
}
template Option Builder::option(const std::string&, std::string&, const std::string&);
template Option Builder::option(const std::string&, std::filesystem::path&, const std::string&);
template Option Builder::option(const std::string&, double&, const std::string&);
template Option Builder::option(const std::string&, unsigned&, const std::string&);
template Option Builder::option(const std::string&, std::uint64_t&, const std::string&);
template Option Builder::option(const std::string&, std::optional<std::string>&,
                                const std::string&);
template Option Builder::option(const std::string&, std::optional<double>&, const std::string&);
template Option Builder::option(const std::string&, std::optional<unsigned>&, const std::string&);
template Option Builder::option(const std::string&, std::optional<std::uint64_t>&,
                                const std::string&);
template Option Builder::option(const std::string&, std::vector<std::string>&, const std::string&);
template Option Builder::option(const std::string&, std::vector<std::filesystem::path>&,
                                const std::string&);

void Builder::flag(const std::string& name, bool& value, const std::string& description) {
  current_->add_flag(name, value, description)->group(groupOf(name));
}

void Builder::shortcut(const std::string& name, const std::string& description,
                       const std::function<void(const std::string&)>& take) {
  current_->add_option_function<std::string>(name, take, description)->group(group_);
}

void Builder::footer(std::function<std::string()> text) { current_->footer(std::move(text)); }

std::size_t Builder::options() const { return current_->get_options().size(); }

void Builder::afterParsing(std::function<void()> action) {
  afterParsing_->push_back(std::move(action));
}

void Builder::keepGiven(std::size_t from, std::vector<std::string>& words) {
  const std::vector<CLI::Option*> all = current_->get_options();
  const std::vector<CLI::Option*> ours(all.begin() + static_cast<std::ptrdiff_t>(from), all.end());
  afterParsing([ours, &words] {
    for (const CLI::Option* option : ours) {
      if (option->count() == 0) continue;
      words.push_back("--" + option->get_lnames().front());
      if (option->get_items_expected_max() == 0) continue;  // a flag
      words.insert(words.end(), option->results().begin(), option->results().end());
    }
  });
}

Option Builder::shard(std::string& shard, std::string& job) {
  Option declared =
      option("--shard", shard,
             "I/N: do the I-th of N parts of the work only, and write a part for `ortung merge`");
  afterParsing([command = current_, &job] {
    nlohmann::ordered_json options;
    for (const CLI::Option* one : command->get_options()) {
      const std::string name = one->get_name();
      if (neverMatters(name)) continue;
      // Where nothing is given, the default tells; an option without one is like one not given.
      if (one->count() > 0)
        options[name] = one->results();
      else if (!one->get_default_str().empty())
        options[name] = {one->get_default_str()};
    }
    job = options.dump(-1, ' ', true, nlohmann::json::error_handler_t::replace);
  });
  return declared;
}

}  // namespace ortung::app

#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "CommandLine.hpp"

namespace CLI {  // NOLINT(readability-identifier-naming): the library's own
class App;
class Option;
}  // namespace CLI

// CLI11 takes long to compile, so sources that declare options do not include it.
namespace ortung::app {

inline constexpr const char* kProgress = "Draw a progress bar even if stderr is not a terminal";
inline constexpr const char* kForce =
    "Overwrite files of other kinds (but never files that the run reads)";
inline constexpr const char* kSource =
    "KIND:PATH?key=value, e.g. record:run.rec; `ortung plugins` lists the kinds";

/// One option of a command; its functions add properties.
class Option {
 public:
  explicit Option(CLI::Option& option) : option_(option) {}
  Option& required();
  Option& showsDefault();                   ///< shows the default in the help
  Option& within(double low, double high);  ///< requires a finite number in [low, high]
  Option& oneOf(const std::vector<std::string>& words);
  Option& repeats();                     ///< the option is given once for each value
  Option& splitsAt(char delimiter);      ///< one word has several values
  Option& expects(int least, int most);  ///< limits the number of values
  Option& hides();                       ///< hides the option in the help

 private:
  CLI::Option& option_;
};

/// Declares commands and the options of the newest one.
class Builder {
 public:
  /// @param root root of the command line; must outlive this, as must @p parsed
  /// @param commandLine the command line as it was given
  Builder(CLI::App& root, ParsedCommand& parsed, std::string commandLine);

  /// Declares a command.
  /// @param name its name in the catalogue, e.g. "export map"; the catalogue has its summary, too
  /// @return the arguments, which options fill in for @p run
  template <class Arguments>
  std::shared_ptr<Arguments> command(const std::string& name, const std::string& example,
                                     int (*run)(const Arguments&)) {
    auto arguments = std::make_shared<Arguments>();
    begin(name, example, [arguments, run] { return run(*arguments); });
    return arguments;
  }
  /// Declares an option whose value is text, a path, a number, an optional one of these, or a
  /// vector of texts or paths.
  template <class Value>
  Option option(const std::string& names, Value& value, const std::string& description);
  void flag(const std::string& name, bool& value, const std::string& description);
  /// Declares an option that stands for other ones.
  void shortcut(const std::string& name, const std::string& description,
                const std::function<void(const std::string&)>& take);
  /// Options that are declared from now on, up to the next call or command, are under this heading
  /// of the help.
  void group(const std::string& heading) { group_ = heading; }
  const std::string& group() const { return group_; }
  /// Replaces the end of the help, by default the example; made when the help is printed.
  void footer(std::function<std::string()> text);

  const std::string& commandLine() const { return commandLine_; }
  /// Returns how many options the command has by now.
  std::size_t options() const;
  /// Stores, once the command line is parsed, the words that set the options from number @p from up
  /// to here, for another command that has these options, too.
  void keepGiven(std::size_t from, std::vector<std::string>& words);
  /// Declares the option --shard of a command whose work can be cut.
  /// @param job gets all other options as a JSON object, once the command line is parsed: whatever
  ///   the result depends on, since only those are left out that never matter (threads, outputs)
  Option shard(std::string& shard, std::string& job);

 private:
  void begin(const std::string& name, const std::string& example, std::function<int()> run);
  void afterParsing(std::function<void()> action);
  std::string groupOf(const std::string& name) const;

  CLI::App& root_;
  ParsedCommand& parsed_;
  std::string commandLine_;
  CLI::App* current_ = nullptr;
  std::string group_;
  /// What the command does once its options are parsed; the library keeps one function only.
  std::shared_ptr<std::vector<std::function<void()>>> afterParsing_;
};

/// While one lives, options that are declared are under a heading of their own in the help.
class HelpGroup {
 public:
  HelpGroup(Builder& build, const std::string& heading) : build_(build), before_(build.group()) {
    build.group(heading);
  }
  ~HelpGroup() { build_.group(before_); }
  HelpGroup(const HelpGroup&) = delete;
  HelpGroup& operator=(const HelpGroup&) = delete;

 private:
  Builder& build_;
  std::string before_;
};

}  // namespace ortung::app

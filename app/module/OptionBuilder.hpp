#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "CommandLine.hpp"

namespace CLI {
class App;
class Option;
}  // namespace CLI

// CLI11 takes long to compile, so it ends here: sources that declare options don't see it.
namespace ortung::app {

inline constexpr const char* kProgress = "Draw a progress bar even if stderr is no terminal";
inline constexpr const char* kForce =
    "Overwrite files that hold something else than what is written (never what the run reads)";
inline constexpr const char* kSource =
    "KIND:PATH?key=value, e.g. record:run.rec; `ortung plugins` lists the kinds";

/// One option of a command, to be told more of.
class Option {
 public:
  explicit Option(CLI::Option& option) : option_(option) {}
  Option& required();
  Option& showsDefault();                   ///< in the help
  Option& within(double low, double high);  ///< a finite number
  Option& oneOf(const std::vector<std::string>& words);
  Option& repeats();                     ///< once for each value
  Option& splitsAt(char delimiter);      ///< values in one word
  Option& expects(int least, int most);  ///< values
  Option& hides();                       ///< not in the help

 private:
  CLI::Option& option_;
};

/// Declares commands and the options of the newest one.
class Builder {
 public:
  /// @param root of the command line; must outlive this, as must @p parsed
  /// @param commandLine as it was given
  Builder(CLI::App& root, ParsedCommand& parsed, std::string commandLine);

  /// @param name as the catalogue has it, e.g. "export map", which also says what the command is
  /// for
  /// @return what the options fill in, for @p run
  template <class Arguments>
  std::shared_ptr<Arguments> command(const std::string& name, const std::string& example,
                                     int (*run)(const Arguments&)) {
    auto arguments = std::make_shared<Arguments>();
    begin(name, example, [arguments, run] { return run(*arguments); });
    return arguments;
  }
  /// For texts, paths, numbers, optional ones, and vectors of texts and paths.
  template <class Value>
  Option option(const std::string& names, Value& value, const std::string& description);
  void flag(const std::string& name, bool& value, const std::string& description);
  /// An option that is short for something else.
  void shortcut(const std::string& name, const std::string& description,
                std::function<void(const std::string&)> take);
  /// The end of the help, in place of the example alone; made when somebody asks for it.
  void footer(std::function<std::string()> text);

  const std::string& commandLine() const { return commandLine_; }
  /// How many options the command has by now.
  std::size_t options() const;
  /// Fills in, once the command line is read, the words that gave the options from number @p from
  /// up to here, for another command that has these, too.
  void keepGiven(std::size_t from, std::vector<std::string>& words);

 private:
  void begin(const std::string& name, const std::string& example, std::function<int()> run);

  CLI::App& root_;
  ParsedCommand& parsed_;
  std::string commandLine_;
  CLI::App* current_ = nullptr;
};

}  // namespace ortung::app

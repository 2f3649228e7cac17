#pragma once

#include <fmt/format.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <charconv>
#include <memory>
#include <string>

#include "CommandLine.hpp"

// CLI11 takes long to compile: for sources that declare options alone.
namespace ortung::app {

inline constexpr const char* kProgress = "Draw a progress bar even if stderr is no terminal";
inline constexpr const char* kForce =
    "Overwrite files that hold something else than what is written (never what the run reads)";
inline constexpr const char* kSource =
    "KIND:PATH?key=value, e.g. record:run.rec; `ortung plugins` lists the kinds";

/// A finite number within bounds; CLI11's own Range lets NaN pass.
inline CLI::Validator within(double low, double high) {
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

template <class Arguments>
using Runner = int (*)(const Arguments&);

/// Declares subcommands and the options of the newest one.
class Builder {
 public:
  explicit Builder(ParsedCommand& parsed) : parsed_(parsed) {}

  template <class Arguments>
  std::shared_ptr<Arguments> command(CLI::App& app, const char* name, const char* description,
                                     const char* example, Runner<Arguments> run) {
    auto arguments = std::make_shared<Arguments>();
    current_ = app.add_subcommand(name, description);
    current_->footer(std::string("Example:\n  ") + example);
    current_
        ->add_option("--plugin-seconds", parsed_.pluginSeconds,
                     "How long a plugin may take for one call before the program saves what it has "
                     "and ends [s]; 0: for ever")
        ->check(within(0.0, 1e6))
        ->capture_default_str();
    const std::string called =
        app.get_parent() == nullptr ? name : app.get_name() + " " + name;  // one of a subcommand
    current_->callback([parsed = &parsed_, arguments, called, run] {
      parsed->name = called;
      parsed->run = [arguments, run] { return run(*arguments); };
    });
    return arguments;
  }
  template <class Value>
  CLI::Option* option(const char* names, Value& value, const char* description) {
    return current_->add_option(names, value, description);
  }
  void flag(const char* name, bool& value, const char* description) {
    current_->add_flag(name, value, description);
  }
  CLI::App& app() { return *current_; }

 private:
  ParsedCommand& parsed_;
  CLI::App* current_ = nullptr;
};

}  // namespace ortung::app

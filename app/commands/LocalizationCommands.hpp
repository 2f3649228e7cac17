#pragma once

#include <CLI/App.hpp>
#include <string>

namespace ortung::app {

class Builder;
struct ViewArguments;

// Subcommands that localize.

/// @param commandLine as it was given, for the report
void addEval(Builder& build, CLI::App& app, const std::string& commandLine);
void addCompare(Builder& build, CLI::App& app);
void addView(Builder& build, CLI::App& app);
/// Which runs a viewer shows.
void addRuns(Builder& build, ViewArguments& a);
void addLocalize(Builder& build, CLI::App& app);

}  // namespace ortung::app

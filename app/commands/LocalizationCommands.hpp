#pragma once

#include <CLI/App.hpp>
#include <string>

namespace ortung::app {

class Builder;

// Subcommands that localize.

/// @param commandLine as it was given, for the report
void addEval(Builder& build, CLI::App& app, const std::string& commandLine);
void addCompare(Builder& build, CLI::App& app);
void addView(Builder& build, CLI::App& app);
void addLocalize(Builder& build, CLI::App& app);

}  // namespace ortung::app

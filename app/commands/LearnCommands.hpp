#pragma once

#include <CLI/App.hpp>

namespace ortung::app {

class Builder;

// Subcommands that learn.

void addLearn(Builder& build, CLI::App& app);
void addLearnMotion(Builder& build, CLI::App& app);
void addTrainMotion(Builder& build, CLI::App& app);

}  // namespace ortung::app

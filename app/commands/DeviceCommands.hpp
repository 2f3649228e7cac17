#pragma once

#include <CLI/App.hpp>

namespace ortung::app {

class Builder;

// Subcommands about the devices of a real robot.

void addRobot(Builder& build, CLI::App& app);
void addEmulate(Builder& build, CLI::App& app);

}  // namespace ortung::app

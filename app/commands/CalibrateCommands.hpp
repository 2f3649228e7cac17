#pragma once

namespace CLI {
class App;
}

namespace ortung::app {

class Builder;

/// `ortung calibrate` and its own subcommands.
void addCalibrate(Builder& build, CLI::App& app);

}  // namespace ortung::app

#pragma once

namespace CLI {
class App;
}

namespace ortung::app {

class Builder;

/// `ortung benchmark` and its own subcommands.
void addBenchmark(Builder& build, CLI::App& app);

}  // namespace ortung::app

#pragma once

namespace CLI {
class App;
}

namespace ortung::app {

class Builder;

/// `ortung export` and its own subcommands.
void addExport(Builder& build, CLI::App& app);

}  // namespace ortung::app

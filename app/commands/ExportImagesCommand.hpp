#pragma once

namespace CLI {
class App;
}

namespace ortung::app {

class Builder;

/// `images` of `ortung export`.
void addExportImages(Builder& build, CLI::App& app);

}  // namespace ortung::app

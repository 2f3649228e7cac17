#include "CommandModule.hpp"
#include "Plugins.hpp"
#include "OptionBuilder.hpp"

namespace ortung::app {
namespace {

void addPlugins(Builder& build) {
  const auto a = build.command<PluginsArguments>(
      "plugins", "ORTUNG_PLUGIN_PATH=~/my-plugins ortung plugins", runPlugins);
  build.option("--timeout", a->timeout, "How long a library may take to load [s]")
      .within(0.1, 3600.0)
      .showsDefault();
  build.option("--inside", a->inside, "").hides();  // not shown: the command's own
}

}  // namespace
}  // namespace ortung::app

ORTUNG_COMMAND_MODULE(ortung::app::addPlugins)

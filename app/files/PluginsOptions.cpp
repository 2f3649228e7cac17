#include "CommandModule.hpp"
#include "OptionBuilder.hpp"
#include "Plugins.hpp"

namespace ortung::app {
namespace {

void addPlugins(Builder& build) {
  const auto a = build.command<PluginsArguments>(
      "plugins", "ortung plugins sensor lrf\n  ORTUNG_PLUGIN_PATH=~/my-plugins ortung plugins",
      runPlugins);
  build.option("kind", a->kind, "List plugins of one kind: " + kindsText());
  build.option("name", a->name, "Show what its part of a file may hold, or what its options are");
  build.flag("--paths", a->paths,
             "Also show which parts each plugin of a kind has, and the libraries that have them");
  build.option("--timeout", a->timeout, "Longest time to load a library [s]")
      .within(0.1, 3600.0)
      .showsDefault();
  build.option("--inside", a->inside, "").hides();  // not shown: for the child process
}

}  // namespace
}  // namespace ortung::app

ORTUNG_COMMAND_MODULE(ortung::app::addPlugins)

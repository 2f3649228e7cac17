#include "ortung/core/Plugin.hpp"
#include "ortung/core/SourceHelp.hpp"
#include "ortung/core/SourceOptions.hpp"
#include "ortung/devices/DevicesSource.hpp"

namespace ortung {
namespace {

DevicesSource::Config readConfig(const Parameters& p) {
  DevicesSource::Config config;
  config.robot = p.text("path");
  p.textOr("robot_file", "");  // what the readings are for; where they come from, the path says
  config.dev = p.textOr("dev", "");
  config.duration = optionNumber(p, "duration", {0.0, 1e9});
  return config;
}

class DevicesPlugin : public DevicesSource {
 public:
  explicit DevicesPlugin(const Parameters& p) : DevicesSource(readConfig(p)) {}
};

/// What `ortung import devices --help` tells.
class DevicesHelp : public SourceHelp {
 public:
  explicit DevicesHelp(const Parameters&)
      : SourceHelp("robot file whose sensors name devices",
                   {{"dev", "", "/dev", "folder of the links of emulated devices"},
                    {"duration", "s", "until a signal", "how long to read"}}) {}
};

}  // namespace
}  // namespace ortung

ORTUNG_PLUGINS("devices_source", ortung::provide<ortung::Source, ortung::DevicesPlugin>("devices"),
               ortung::provide<ortung::SourceHelp, ortung::DevicesHelp>("devices"));

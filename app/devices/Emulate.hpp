#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace ortung::app {

/// Arguments of `ortung emulate`.
struct EmulateArguments {
  std::string kind = "all";  ///< device: "sick", "hokuyo", "base", "lines"; all: robot file's
  std::filesystem::path robot;
  std::filesystem::path world;      ///< world; "": a source is given
  std::string source;               ///< source of the readings; "": a world is given
  std::filesystem::path dev;        ///< folder for links named like the ports; "": none
  std::filesystem::path link;       ///< link to the terminal of a single device; "": none
  std::optional<unsigned> tcp;      ///< port of a single device
  std::optional<unsigned> baud;     ///< speed of a single device [bit/s]
  std::vector<std::string> faults;  ///< faults, "[DEVICE=]KIND[:VALUE][@FROM-TO]"
  double clockOffset = 1000.0;      ///< time of the devices' clocks at the start [s]
  double clockDriftPpm = 0.0;       ///< drift of the devices' clocks [ppm]
  double speed = 1.0;               ///< emulated time / real time
  bool waits = false;               ///< whether to wait until all devices were asked to measure
  std::uint64_t seed = 1;
};
int runEmulate(const EmulateArguments& arguments);
/// Describes the faults of emulated devices, for help.
std::string emulateHelp();

}  // namespace ortung::app

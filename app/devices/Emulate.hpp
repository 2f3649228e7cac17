#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace ortung::app {

struct EmulateArguments {
  std::string kind = "all";  ///< "sick", "hokuyo", "base", "lines", or all of the robot file
  std::filesystem::path robot;
  std::filesystem::path world;      ///< "": a source is given
  std::string source;               ///< "": a world is given
  std::filesystem::path dev;        ///< folder for links named like the ports; "": none
  std::filesystem::path link;       ///< of a single device; "": none
  std::optional<unsigned> tcp;      ///< port of a single device
  std::optional<unsigned> baud;     ///< of a single device
  std::vector<std::string> faults;  ///< "[DEVICE=]KIND[:VALUE][@FROM-TO]"
  double clockOffset = 1000.0;      ///< of the devices' clocks [s]
  double clockDriftPpm = 0.0;
  double speed = 1.0;
  bool waits = false;  ///< time begins when all devices have been asked to measure
  std::uint64_t seed = 1;
};
int runEmulate(const EmulateArguments& arguments);
/// What goes wrong with emulated devices, for help.
std::string emulateHelp();

}  // namespace ortung::app

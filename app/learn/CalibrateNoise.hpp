#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace ortung::app {

struct CalibrateNoiseArguments {
  std::vector<std::string> sources;  ///< records, or "KIND:PATH?key=value"
  std::filesystem::path robot;
  std::filesystem::path tables;
  std::filesystem::path out;       ///< robot file; "" for none
  std::string reference = "auto";  ///< "truth", "track" or "auto": truth where there is one
  std::vector<std::string> fixed;  ///< "bias", "mount", "latency": not learned
  std::filesystem::path motion;    ///< of the track; "": that of the robot file
  std::uint64_t seed = 1;          ///< of the track
  bool anyWorld = false;
  bool force = false;
  bool progress = false;
};
int runCalibrateNoise(const CalibrateNoiseArguments& arguments);

}  // namespace ortung::app

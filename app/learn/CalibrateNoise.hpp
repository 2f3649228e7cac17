#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace ortung::app {

/// Arguments of `ortung calibrate noise`.
struct CalibrateNoiseArguments {
  std::vector<std::string> sources;  ///< records, or "KIND:PATH?key=value"
  std::filesystem::path robot;
  std::filesystem::path tables;
  std::filesystem::path out;       ///< robot file to write; "": none
  std::string reference = "auto";  ///< poses: "truth", "track", or "auto": truth if there is one
  std::vector<std::string> fixed;  ///< terms that are not learned: "bias", "mount", "latency"
  std::filesystem::path motion;    ///< motion model of the track; "": that of the robot file
  std::uint64_t seed = 1;          ///< seed of the track
  bool anyWorld = false;
  bool force = false;
  bool progress = false;
};
int runCalibrateNoise(const CalibrateNoiseArguments& arguments);

}  // namespace ortung::app

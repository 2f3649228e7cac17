#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "PartSet.hpp"

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
  std::string shard;  ///< "I/N": read some of the sources only; "": all
  std::string job;    ///< all options, see Builder::shard()
  bool force = false;
  bool progress = false;
};
int runCalibrateNoise(const CalibrateNoiseArguments& arguments);

/// Learns from the readings of all parts as one process does with all sources, and tells it.
/// @return the robot file with what was learned
/// @throws PartError if robot file or tables are others than those of the parts
std::string mergeNoise(const PartSet& parts);

}  // namespace ortung::app

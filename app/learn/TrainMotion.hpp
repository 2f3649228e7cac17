#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace ortung::app {

/// Arguments of `ortung train-motion`.
struct TrainMotionArguments {
  std::vector<std::string> sources;  ///< records, or "KIND:PATH?key=value"
  std::filesystem::path robot;
  std::filesystem::path out;
  std::string commandsFrom = "auto";  ///< odometry's "velocities" or "motion_data", or "auto"
  double step = 0.1;                  ///< time step of a prediction [s]
  std::size_t commands = 5;           ///< number of newest commands that the network sees
  std::string hidden = "24,24";       ///< widths of the hidden layers
  std::size_t iterations = 300;
  double holdOut = 0.25;  ///< share of each log, at its end, that is held out
  std::uint64_t seed = 1;
  bool force = false;  ///< whether to overwrite files of other kinds
  bool progress = false;
};
int runTrainMotion(const TrainMotionArguments& arguments);

}  // namespace ortung::app

#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace ortung::app {

/// Arguments of `ortung learn-motion`.
struct LearnMotionArguments {
  std::vector<std::string> sources;  ///< records, or "KIND:PATH?key=value"
  std::filesystem::path robot;
  std::filesystem::path out;
  std::string plugin;            ///< motion model to learn; "": that of the robot file
  std::filesystem::path motion;  ///< file with [motion] to begin with; "": none
  double interval = 0.5;         ///< duration of the shortest pieces [s]
  double from = 0.0;             ///< begin of the used part of a log, as a share of its time
  double to = 1.0;               ///< end of the used part of a log, as a share of its time
  std::optional<double> delay;   ///< delay of odometry [s]; nothing: learned
  bool force = false;            ///< whether to overwrite files of other kinds
  bool progress = false;
};
int runLearnMotion(const LearnMotionArguments& arguments);

}  // namespace ortung::app

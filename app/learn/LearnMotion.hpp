#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace ortung::app {

struct LearnMotionArguments {
  std::vector<std::string> sources;  ///< records, or "KIND:PATH?key=value"
  std::filesystem::path robot;
  std::filesystem::path out;
  std::string plugin;            ///< the motion model to teach; "": that of the robot file ...
  std::filesystem::path motion;  ///< ... or a file with [motion] to begin with; "" for none
  double interval = 0.5;         ///< of the shortest pieces [s]
  double from = 0.0;             ///< part of each log to learn from, as shares of its time
  double to = 1.0;
  std::optional<double> delay;  ///< of odometry [s]; nothing: learned
  bool force = false;           ///< whether to overwrite files of other kinds
  bool progress = false;
};
int runLearnMotion(const LearnMotionArguments& arguments);

}  // namespace ortung::app

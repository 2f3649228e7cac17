#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace ortung::app {

/// Arguments of `ortung learn`.
struct LearnArguments {
  std::filesystem::path world;
  std::filesystem::path robot;
  std::filesystem::path out;
  double cell = 0.1;                  ///< size of a cell [m]
  double headingStepDeg = 2.0;        ///< step of headings [degrees]
  std::string area = "auto";          ///< part of the floor: "auto", "all" or "x,y" [m]
  std::vector<std::string> settings;  ///< other values for keys of the robot file, "KEY=VALUE"
  std::string shard;                  ///< part of the work, "I/N"; "": all of it
  std::string job;                    ///< all options on which the tables depend, as JSON
  unsigned threads = 1;
  bool force = false;  ///< whether to overwrite files of other kinds
  bool progress = false;
};
int runLearn(const LearnArguments& arguments);

/// Returns the part of the floor as learners expect it: "auto", "all" or "x;y". @throws UsageError
std::string areaOf(const LearnArguments& arguments);

}  // namespace ortung::app

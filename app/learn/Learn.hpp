#pragma once

#include <filesystem>
#include <string>

namespace ortung::app {

struct LearnArguments {
  std::filesystem::path world;
  std::filesystem::path robot;
  std::filesystem::path out;
  double cell = 0.1;            ///< [m]
  double headingStepDeg = 2.0;  ///< [degrees]
  std::string area = "auto";    ///< "auto", "all" or "x,y" [m]: which part of the floor
  unsigned threads = 1;
  bool force = false;  ///< whether to overwrite files of other kinds
  bool progress = false;
};
int runLearn(const LearnArguments& arguments);

}  // namespace ortung::app

#pragma once

#include <filesystem>
#include <vector>

namespace ortung::app {

struct CheckArguments {
  std::vector<std::filesystem::path> files;
  std::filesystem::path world;  ///< "" for none
  std::filesystem::path robot;  ///< "" for none
  bool mend = false;            ///< cut off what a killed recorder left of its last moment
};
int runCheck(const CheckArguments& arguments);

}  // namespace ortung::app

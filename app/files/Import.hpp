#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace ortung::app {

struct ImportArguments {
  std::string kind;
  std::string source;
  std::filesystem::path out;
  std::filesystem::path world;       ///< "" for none
  std::filesystem::path robotFile;   ///< "" for none
  std::vector<std::string> options;  ///< "key=value"
  std::filesystem::path withRobot;   ///< robot file for sources that need one; "" for none
  bool force = false;
  bool progress = false;
};
int runImport(const ImportArguments& arguments);
/// What the help of import says of a kind of source, or which kinds there are if it is "".
std::string importHelp(const std::string& kind);

}  // namespace ortung::app

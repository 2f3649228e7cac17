#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace ortung::app {

/// Arguments of `ortung import`.
struct ImportArguments {
  std::string kind;
  std::string source;
  std::filesystem::path out;
  std::filesystem::path world;       ///< world file to write; "": none
  std::filesystem::path robotFile;   ///< robot file to write; "": none
  std::vector<std::string> options;  ///< options of the source, "key=value"
  std::filesystem::path withRobot;   ///< robot file for sources that need one; "": none
  bool force = false;
  bool progress = false;
};
int runImport(const ImportArguments& arguments);
/// Returns the help of import for a kind of source, or the list of kinds if @p kind is "".
std::string importHelp(const std::string& kind);

}  // namespace ortung::app

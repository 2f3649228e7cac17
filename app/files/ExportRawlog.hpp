#pragma once

#include <filesystem>
#include <string>

namespace ortung::app {

/// Arguments of `ortung export rawlog`.
struct ExportRawlogArguments {
  std::string source;
  std::filesystem::path robot;
  std::filesystem::path out;
  std::filesystem::path truth;  ///< file for the ground truth; "": none
  bool force = false;
  bool progress = false;
};
int runExportRawlog(const ExportRawlogArguments& arguments);

}  // namespace ortung::app

#pragma once

#include <filesystem>
#include <string>

namespace ortung::app {

struct ExportRawlogArguments {
  std::string source;
  std::filesystem::path robot;
  std::filesystem::path out;
  std::filesystem::path truth;  ///< "" for none
  bool force = false;
  bool progress = false;
};
int runExportRawlog(const ExportRawlogArguments& arguments);

}  // namespace ortung::app

#pragma once

#include <filesystem>

namespace ortung::app {

struct ExportMapArguments {
  std::filesystem::path world;
  std::filesystem::path out;
  double cell = 0.05;   ///< [m]
  double height = 0.3;  ///< of the plane that is drawn [m]
  bool force = false;
};
int runExportMap(const ExportMapArguments& arguments);

}  // namespace ortung::app

#pragma once

#include <filesystem>

namespace ortung::app {

/// Arguments of `ortung export map`.
struct ExportMapArguments {
  std::filesystem::path world;
  std::filesystem::path out;
  double cell = 0.05;   ///< size of a cell [m]
  double height = 0.3;  ///< height of the plane that is drawn [m]
  bool force = false;
};
int runExportMap(const ExportMapArguments& arguments);

}  // namespace ortung::app

#pragma once

#include <filesystem>

namespace ortung::app {

/// Arguments of `ortung mend-map`.
struct MendMapArguments {
  std::filesystem::path world;
  std::filesystem::path changes;
  std::filesystem::path out;
  std::filesystem::path picture;
  double cell = 0.05;   ///< size of a cell [m]
  double height = 0.3;  ///< height of the plane that is drawn [m]
  bool force = false;
};
int runMendMap(const MendMapArguments& arguments);

}  // namespace ortung::app

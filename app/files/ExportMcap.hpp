#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace ortung::app {

/// Arguments of `ortung export mcap`.
struct ExportMcapArguments {
  std::string source;
  std::filesystem::path robot;
  std::filesystem::path out;
  std::filesystem::path tables;   ///< tables whose map is drawn; "": none
  std::filesystem::path world;    ///< world whose map is drawn; "": none
  double cell = 0.05;             ///< size of a cell of a world's map [m]
  double height = 0.3;            ///< height of the plane that is drawn [m]
  std::string mapFrame = "best";  ///< pose of odometry in the map: "best", "truth", "none"
  bool localizes = false;         ///< whether to localize with the tables first
  std::string start = "global";   ///< start of that localization's belief
  std::uint64_t seed = 1;         ///< seed of that localization
  bool force = false;
  bool progress = false;
};
int runExportMcap(const ExportMcapArguments& arguments);

}  // namespace ortung::app

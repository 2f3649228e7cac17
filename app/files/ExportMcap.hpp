#pragma once

#include <filesystem>
#include <string>

namespace ortung::app {

struct ExportMcapArguments {
  std::string source;
  std::filesystem::path robot;
  std::filesystem::path out;
  std::filesystem::path tables;   ///< of which the map is drawn; "" for none
  std::filesystem::path world;    ///< likewise
  double cell = 0.05;             ///< of a world's map [m]
  double height = 0.3;            ///< of the plane that is drawn [m]
  std::string mapFrame = "best";  ///< "best", "truth" or "none"
  bool force = false;
  bool progress = false;
};
int runExportMcap(const ExportMcapArguments& arguments);

}  // namespace ortung::app

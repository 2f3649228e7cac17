#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace ortung::app {

/// Arguments that commands that localize have in common.
struct LocalizationArguments {
  std::string source;  ///< source of the readings, "KIND:PATH?key=value"
  std::filesystem::path robot;
  std::filesystem::path tables;
  std::uint64_t seed = 1;
  std::optional<std::uint64_t> particles;
  std::optional<unsigned> threads;
  std::string start = "global";  ///< start of the belief: "global", "truth" or "x,y,theta_deg"
  std::string startSigma = "0.3,10";
  std::string motion;          ///< file, or "turn_per_turn,turn_per_m,way_per_m,way_per_turn"
  std::string filter = "mcl";  ///< kind of filter: "mcl" or "grid"
  std::string grid = "0.1,5";  ///< grid filter's cell [m] and step of headings [degrees]
  std::vector<std::string> settings;  ///< other values for keys of the robot file, "KEY=VALUE"
  bool besideGrid = false;            ///< whether to compare MCL with the grid filter
  bool anyWorld = false;
  bool publish = false;  ///< whether to put estimates into the container
  bool force = false;    ///< whether to overwrite files of other kinds
  bool progress = false;
};

}  // namespace ortung::app

#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

namespace ortung::app {

/// What eval and localize have in common.
struct LocalizationArguments {
  std::string source;  ///< "KIND:PATH?key=value"
  std::filesystem::path robot;
  std::filesystem::path tables;
  std::uint64_t seed = 1;
  std::optional<std::uint64_t> particles;
  std::optional<unsigned> threads;
  std::string start = "global";  ///< "global", "truth" or "x,y,theta_deg"
  std::string startSigma = "0.3,10";
  std::string motion;          ///< file, "turn_per_turn,turn_per_m,way_per_m,way_per_turn" or ""
  std::string filter = "mcl";  ///< "mcl" or "grid"
  std::string grid = "0.1,5";  ///< of the grid filter: cell [m], step of headings [degrees]
  bool besideGrid = false;     ///< MCL, compared with the grid filter
  bool anyWorld = false;
  bool publish = false;  ///< put estimates into the container, for whoever reads that
  bool force = false;    ///< whether to overwrite files of other kinds
  bool progress = false;
};

}  // namespace ortung::app

#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace ortung::app {

/// Arguments of `ortung show`.
struct ShowArguments {
  std::filesystem::path tables;
  std::filesystem::path robot;
  std::vector<std::string> features;  ///< features, "model/type/feature", * for any
  std::filesystem::path out;
  std::filesystem::path record;      ///< record with the reading; "": none
  std::string source;                ///< source with the reading; "": none
  double at = 0.0;                   ///< time of the reading after the first one [s]
  std::optional<double> headingDeg;  ///< heading of the robot [degrees]; nothing: see help
  std::size_t beam = 0;              ///< index of the feature's value
  std::string scale = "auto";        ///< scale of probabilities: "auto", "linear" or "log"
  bool logarithmic = false;          ///< whether the scale is "log", whatever `scale` is
  bool force = false;                ///< whether to overwrite files of other kinds
  bool progress = false;
};
int runShow(const ShowArguments& arguments);

}  // namespace ortung::app

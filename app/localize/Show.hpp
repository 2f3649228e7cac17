#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace ortung::app {

struct ShowArguments {
  std::filesystem::path tables;
  std::filesystem::path robot;
  std::vector<std::string> features;  ///< "model/type/feature", any of them
  std::filesystem::path out;
  std::filesystem::path record;      ///< record with the reading; "": none
  std::string source;                ///< "" for none
  double at = 0.0;                   ///< of the reading [s] after the first one
  std::optional<double> headingDeg;  ///< [degrees]
  std::size_t beam = 0;
  std::string scale = "auto";  ///< of probabilities: "auto", "linear" or "log"
  bool logarithmic = false;    ///< "log", whatever `scale` says
  bool force = false;          ///< whether to overwrite files of other kinds
  bool progress = false;
};
int runShow(const ShowArguments& arguments);

}  // namespace ortung::app

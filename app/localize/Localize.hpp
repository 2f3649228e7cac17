#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "LocalizationArguments.hpp"

namespace ortung::app {

/// Arguments of `ortung localize`.
struct LocalizeArguments {
  LocalizationArguments localization;
  std::filesystem::path out;     ///< file to write; "": stdout
  std::filesystem::path belief;  ///< file of the belief; "": none
  std::optional<double> rate;    ///< rate of poses [Hz]; nothing: a pose for each update
  std::string format = "text";   ///< format of poses: "text", "json" or "tum"
  std::filesystem::path record;  ///< record of readings and results; "": none
  std::filesystem::path truth;   ///< file for the ground truth in TUM's format; "": none
};
int runLocalize(const LocalizeArguments& arguments);

}  // namespace ortung::app

#pragma once

#include <filesystem>
#include <optional>

#include "LocalizationArguments.hpp"
#include "ServingArguments.hpp"

namespace ortung::app {

/// Arguments of `ortung robot`.
struct RobotArguments {
  LocalizationArguments localization;  ///< no source; tables "": does not localize
  std::filesystem::path dev;           ///< folder in place of /dev; "": the real one
  std::filesystem::path record;        ///< record to write; "": none
  std::filesystem::path out;           ///< file for poses; "": none
  std::optional<double> duration;      ///< time to run [s]; nothing: until a signal
  ServingArguments serving;
};
int runRobot(const RobotArguments& arguments);

}  // namespace ortung::app

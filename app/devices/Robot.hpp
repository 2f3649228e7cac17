#pragma once

#include <filesystem>
#include <optional>

#include "LocalizationArguments.hpp"
#include "ServingArguments.hpp"

namespace ortung::app {

struct RobotArguments {
  LocalizationArguments localization;  ///< tables "": it does not localize; no source
  std::filesystem::path dev;           ///< in place of /dev; "": the real one
  std::filesystem::path record;        ///< record to write; "": none
  std::filesystem::path out;           ///< poses; "" for none
  std::optional<double> duration;      ///< [s]; default: until a signal
  ServingArguments serving;
};
int runRobot(const RobotArguments& arguments);

}  // namespace ortung::app

#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "LocalizationArguments.hpp"
#include "ServingArguments.hpp"

namespace ortung::app {

struct ViewArguments {
  std::vector<std::string> sources;    ///< records, or "KIND:PATH?key=value"
  std::filesystem::path world;         ///< whose field is drawn; "": that of the tables
  LocalizationArguments localization;  ///< its source is not used; tables "": nothing is localized
  ServingArguments serving;
};

}  // namespace ortung::app

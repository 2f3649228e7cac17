#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "LocalizationArguments.hpp"
#include "ServingArguments.hpp"

namespace ortung::app {

/// Arguments of `ortung view`.
struct ViewArguments {
  std::vector<std::string> sources;    ///< records, or "KIND:PATH?key=value"
  std::filesystem::path world;         ///< world whose field is drawn; "": that of the tables
  LocalizationArguments localization;  ///< source is not used; tables "": does not localize
  ServingArguments serving;
  unsigned dropLimit = 2000;  ///< largest file that the page may send [MB]; 0: takes none
};

}  // namespace ortung::app

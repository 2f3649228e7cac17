#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "LocalizationArguments.hpp"

namespace ortung::app {

struct LocalizeArguments {
  LocalizationArguments localization;
  std::filesystem::path out;     ///< file to write; "": stdout
  std::filesystem::path belief;  ///< file of the belief; "": none
  std::optional<double> rate;    ///< of poses [Hz]; without: one an update
  std::string format = "text";   ///< "text", "json" or "tum"
  std::filesystem::path truth;   ///< ground truth of the source as TUM has it; "" for none
};
int runLocalize(const LocalizeArguments& arguments);

}  // namespace ortung::app

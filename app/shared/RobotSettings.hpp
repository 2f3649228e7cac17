#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "OptionBuilder.hpp"

namespace ortung::app {

/// Declares the option --set, other values for keys of the robot file.
inline void addSettings(Builder& build, std::vector<std::string>& settings) {
  build
      .option("--set", settings,
              "KEY=VALUE in place of what the robot file says, as mcl.particles=500 or "
              "sensor.lrf.range_sigma_m=0.1; may be given again")
      .repeats();
}

/// Applies them to all that read the robot file from now on. @throws UsageError
void applySettings(const std::filesystem::path& robot, const std::vector<std::string>& settings);

/// Applies them and does what reads the robot file. An error of a key that was set names the
/// option, since the file's lines are not those of the user's.
/// @returns what @p work returns @throws UsageError
int withSettings(const std::filesystem::path& robot, const std::vector<std::string>& settings,
                 const std::function<int()>& work);

}  // namespace ortung::app

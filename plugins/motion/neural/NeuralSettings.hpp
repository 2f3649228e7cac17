#pragma once

#include <filesystem>
#include <string>

#include "ortung/base/Parameters.hpp"
#include "ortung/motion/MotionNetwork.hpp"
#include "ortung/robot/MotionNetworkFile.hpp"

namespace ortung {

/// The network that `network_file` of [drive] or [motion] names; a relative path begins at the
/// folder of the robot file. @throws ConfigError
inline MotionNetwork readNetworkOf(const Parameters& p) {
  const std::filesystem::path file = p.text("network_file");
  if (file.empty()) p.fail("network_file", "is empty, expected a file of `ortung train-motion`");
  return readMotionNetwork(
      file.is_absolute() ? file : std::filesystem::path(p.where()).parent_path() / file);
}

}  // namespace ortung

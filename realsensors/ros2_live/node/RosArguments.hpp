#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "RosNames.hpp"

namespace ortung::ros2 {

/// A command line as launch files make them: what is between --ros-args and -- is for ROS.
struct RosArguments {
  /// One place from which parameters come; later ones count more.
  struct Parameters {
    std::filesystem::path file;  ///< of parameters; "": a single one
    std::string name, value;     ///< of a single one; the value is YAML
  };
  std::vector<std::string> others;  ///< words that are not for ROS, in their order
  RosNames names;
  bool namesNode = false;  ///< whether the node was given a name
  std::vector<Parameters> parameters;

  /// Understands -r/--remap FROM:=TO (also __node, __ns), -p/--param NAME:=VALUE and
  /// --params-file FILE; --log-level, --enclave and logging switches change nothing.
  /// @param words without the program's name @param node name unless one is given
  /// @throws std::invalid_argument naming the word that was not understood
  static RosArguments read(const std::vector<std::string>& words, const std::string& node);
};

}  // namespace ortung::ros2

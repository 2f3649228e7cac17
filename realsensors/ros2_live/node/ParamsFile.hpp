#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "RosNames.hpp"

namespace ortung::ros2 {

/// A parameter by its name, "initial_pose.x", with a value in YAML: "0.2", "map", "[1, 2]".
struct ParameterText {
  std::string name, value;
  bool isForAll = false;  ///< whether it stands below /**, so that it need not be for this node
  bool operator==(const ParameterText&) const = default;
};
using ParameterTexts = std::vector<ParameterText>;

/// Reads from a file of parameters, as nav2_params.yaml is one, what is for a node: the tables
/// `ros__parameters` below its name, whole or with * for one word of it and ** for any, or below
/// the words of its namespace. Tables in it are names with dots. What is for other nodes is left
/// out.
/// @return in the order of the file; later ones count
/// @throws std::runtime_error naming file and line of what is no such file, and if nothing in it is
///   for the node
ParameterTexts readParamsFile(const std::filesystem::path& file, const RosNames& names);

}  // namespace ortung::ros2

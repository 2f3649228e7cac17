#pragma once

#include <string>
#include <utility>
#include <vector>

namespace ortung::ros2 {

/// What a node is called, and what it calls its topics and services (ROS 2 design, "Topic and
/// Service name mapping" and "Remapping Names").
struct RosNames {
  std::string node = "ortung";
  std::string space = "/";  ///< namespace, which begins with '/'
  /// Names that are others, each with the name in its place; the first one that fits counts.
  std::vector<std::pair<std::string, std::string>> remaps = {};

  /// "/robot/amcl": namespace and name.
  std::string full() const;
  /// The whole name of a topic or service: "scan" is one of the namespace, "~/scan" one of the
  /// node; then remapped.
  std::string resolve(const std::string& name) const;
  /// @throws std::invalid_argument naming what is no name of ROS
  void check() const;

 private:
  std::string expand(const std::string& name) const;
};

}  // namespace ortung::ros2

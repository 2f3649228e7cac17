#pragma once

#include <Eigen/Geometry>
#include <map>
#include <optional>
#include <string>

#include "ortung/ros2/Messages.hpp"

namespace ortung::ros2 {

/// Where frames lie in others, as the messages at /tf and /tf_static tell. Not thread-safe.
class FrameTree {
 public:
  /// Takes a transform; one that is not finite, or whose quaternion is none, is passed over.
  void add(const TransformStamped& transform, bool isStatic);
  /// Where @p frame lies in @p base, by what does not move; else by the last that was told, without
  /// @p base itself, which moves in others. Nothing if they don't hang together.
  std::optional<Eigen::Isometry3d> find(const std::string& frame, const std::string& base) const;
  bool hasFrame(const std::string& frame) const;
  std::size_t size() const { return links_.size(); }

 private:
  struct Link {
    std::string parent;
    Eigen::Isometry3d pose;
    bool isStatic = false;
  };
  /// Climbs to the highest frame; where @p frame lies in it.
  std::pair<std::string, Eigen::Isometry3d> climb(std::string frame, const std::string& base,
                                                  bool staticAlone) const;
  std::map<std::string, Link> links_;  ///< by child
};

}  // namespace ortung::ros2

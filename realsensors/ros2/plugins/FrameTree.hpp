#pragma once

#include <Eigen/Geometry>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "ortung/base/Pose2.hpp"
#include "ortung/ros2/Messages.hpp"

namespace ortung::ros2 {

/// Rounds a float of a message to the decimal from which it was made.
double plain(double number);

/// How a sensor sits on a robot in the plane.
struct PlanarMount {
  Pose2 pose;       ///< in the robot's frame, x and y rounded by plain()
  double up = 1.0;  ///< cosine of the angle between its z axis and the vertical
  bool isUpsideDown() const { return up < 0.0; }
  bool isLevel() const;  ///< within some 11 degrees, either way up
};
PlanarMount onPlane(const Eigen::Isometry3d& sensor);

/// Poses of frames in others, from the messages at /tf and /tf_static. Not thread-safe.
class FrameTree {
 public:
  /// Takes a transform. Returns false for one that is not finite, reaches beyond 1000 km or has a
  /// quaternion of length 0; it is ignored.
  bool add(const TransformStamped& transform, bool isStatic);
  /// Returns the pose of @p frame in @p base by static transforms; if those do not connect the two,
  /// by the newest ones, too, except for that of @p base itself. Nothing if they are not connected.
  std::optional<Eigen::Isometry3d> find(const std::string& frame, const std::string& base) const;
  /// Whether a transform leads to a frame.
  bool hasFrame(const std::string& frame) const;
  /// Returns all frames that transforms lead from or to, sorted.
  std::set<std::string> frames() const;
  std::size_t size() const { return links_.size(); }

  /// All frames of which a transform was told, as parent or child, in alphabetical order.
  std::vector<std::string> names() const;

 private:
  struct Link {
    std::string parent;
    Eigen::Isometry3d pose;
    bool isStatic = false;
  };
  /// Climbs to the highest frame. @return that frame, and the pose of @p frame in it
  std::pair<std::string, Eigen::Isometry3d> climb(std::string frame, const std::string& base,
                                                  bool staticAlone) const;
  std::map<std::string, Link> links_;  ///< transforms by child frame
};

}  // namespace ortung::ros2

#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <optional>
#include <vector>

#include "ortung/base/Time.hpp"
#include "ortung/ros2/Messages.hpp"

namespace ortung::ros2 {

/// How a robot was tilted over time, by whatever tells its attitude in space: an inertial unit, or
/// odometry. Not thread-safe.
class TiltHistory {
 public:
  /// The longest time between a tilt and what it is taken for [us].
  static constexpr Timestamp kLongestGap = 500'000;

  /// @param most number of attitudes that are kept, the newest ones; 0: all
  explicit TiltHistory(std::size_t most = 0) : most_(most) {}
  /// Adds an attitude. @param attitude rotation of the unit in a frame whose z axis points up
  /// @return false for one that is no rotation, which is ignored
  bool add(Timestamp stamp, const Quaternion& attitude);
  bool isEmpty() const { return list_.empty(); }
  std::size_t size() const { return list_.size(); }

  /// Returns the rotation from the robot's frame into one of the same heading that is level: its
  /// roll and pitch. Between two attitudes it is interpolated.
  /// @param unit rotation of the unit in the robot's frame
  /// @return nothing if there is no attitude near enough in time, or the robot lies on its side
  std::optional<Eigen::Matrix3d> at(Timestamp stamp, const Eigen::Matrix3d& unit);

 private:
  struct Upright {
    Timestamp stamp;
    std::array<float, 3> up;  ///< upwards, in the unit's frame
  };
  void sort();
  std::size_t most_;
  bool isSorted_ = true;
  std::vector<Upright> list_;
};

}  // namespace ortung::ros2

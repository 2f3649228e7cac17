#pragma once

#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "CloudShape.hpp"
#include "ortung/base/Pose2.hpp"
#include "ortung/base/Time.hpp"

namespace ortung::ros2 {

/// Velocities of a robot over time, by its odometry. Not thread-safe.
class VelocityHistory {
 public:
  /// The longest time for which a velocity holds [us].
  static constexpr Timestamp kLongest = 500'000;

  /// @param most number of velocities that are kept, the newest ones; 0: all
  explicit VelocityHistory(std::size_t most = 0) : most_(most) {}
  /// Adds a velocity that holds from a time on.
  void add(Timestamp stamp, const PlanarVelocity& velocity);
  /// Adds a pose of odometry that tells no velocity: it is that since the pose before.
  void addPose(Timestamp stamp, const Pose2& pose);
  /// Returns the newest velocity of a time: that of the newest odometry before; without one, that
  /// of the next. Zeros if none is near.
  PlanarVelocity at(Timestamp stamp);

 private:
  void sort();
  std::size_t most_;
  bool isSorted_ = true;
  std::vector<std::pair<Timestamp, PlanarVelocity>> list_;
  std::optional<std::pair<Timestamp, Pose2>> last_;
};

}  // namespace ortung::ros2

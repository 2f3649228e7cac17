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
  /// Returns the velocity at a time: between two odometries it is interpolated; beyond the newest
  /// one, and before the first, theirs holds. Zeros if none is near.
  PlanarVelocity at(Timestamp stamp);

 private:
  void sort();
  std::size_t most_;
  bool isSorted_ = true;
  std::vector<std::pair<Timestamp, PlanarVelocity>> list_;
  std::optional<std::pair<Timestamp, Pose2>> last_;
};

/// Returns how a robot leans and moves during a sweep.
/// @param stamp  the sweep's
/// @param tiltAt returns the robot's tilt at a time, a rotation as SweepMotion has them
template <class TiltAt>
SweepMotion motionDuring(const CloudLayout::Sweep& sweep, Timestamp stamp, TiltAt tiltAt,
                         VelocityHistory& velocities) {
  const auto after = [&](float seconds) {
    return stamp + fromSeconds(static_cast<double>(seconds));
  };
  SweepMotion motion;
  motion.tiltAtBegin = tiltAt(after(sweep.begin));
  motion.tiltAtEnd = sweep.end > sweep.begin ? tiltAt(after(sweep.end)) : motion.tiltAtBegin;
  motion.velocity = velocities.at(after(0.5F * (sweep.begin + sweep.end)));
  return motion;
}

}  // namespace ortung::ros2

#pragma once

// FROZEN, a part of the team footballer-v1: docs/matches.md tells why. Never changed; improvements
// are made in the players of today.

#include <cmath>

#include "View.hpp"
#include "ortung/sim_api/Drive.hpp"

namespace ortung::football_v1 {

/// The approximate place and time at which a robot can first reach the ball.
struct Meeting {
  FloorPoint at;       ///< place of the ball at that time
  double after = 0.0;  ///< time until then [s]
};

/// Searches along the ball's path for the first point that the robot reaches before the ball.
inline Meeting meet(const RollingBall& ball, const Pose2& pose, const DriveLimits& limits) {
  constexpr double kStep = 0.1;     // [s]
  constexpr double kLongest = 4.0;  // [s]
  const double starting =
      limits.acceleration > 0.0 ? 0.5 * limits.speed / limits.acceleration : 0.0;
  const double speed = std::max(limits.speed, 0.1);
  Meeting meeting;
  for (double after = 0.0; after <= kLongest; after += kStep) {
    meeting.at = ball.later(after);
    const FloorPoint way = meeting.at - placeOf(pose);
    const double turning =
        std::abs(wrapAngle(angleOf(way) - pose.theta)) / std::max(limits.turn, 0.1);
    const double needed = lengthOf(way) / speed + 0.5 * turning + starting;
    meeting.after = std::max(after, needed);
    if (needed <= after || ball.speed() < 0.1) break;
  }
  return meeting;
}

}  // namespace ortung::football_v1

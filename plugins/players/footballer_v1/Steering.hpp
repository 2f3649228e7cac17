#pragma once

// FROZEN, a part of the team footballer-v1: docs/matches.md tells why. Never changed; improvements
// are made in the players of today.

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <string>

#include "ortung/sim_api/Player.hpp"

namespace ortung {

/// Turns a robot to a point and drives there.
class Steering {
 public:
  explicit Steering(const DriveLimits& limits) : limits_(limits) {}

  /// Returns whether the robot has arrived; otherwise commands it.
  bool steer(const Pose2& pose, const FloorPoint& to, RobotCommands& robot) const {
    const double away = std::hypot(to.x - pose.x, to.y - pose.y);
    if (away < kArrived) return true;
    const double error = wrapAngle(std::atan2(to.y - pose.y, to.x - pose.x) - pose.theta);
    // The greatest speed from which half the acceleration still stops the robot in time (v^2 = 2 a
    // s).
    const double turn = std::min({limits_.turn, 4.0 * std::abs(error),
                                  std::sqrt(limits_.turnAcceleration * std::abs(error))});
    robot.setRotationalVelocity(error < 0.0 ? -turn : turn);
    const double facing = std::max(1.0 - std::abs(error) / kFacing, 0.0);
    const double braking = std::sqrt(limits_.acceleration * away);
    robot.setTranslationalVelocity(facing * std::min(limits_.speed, braking));
    return false;
  }

  static void stand(RobotCommands& robot) {
    robot.setTranslationalVelocity(0.0);
    robot.setRotationalVelocity(0.0);
  }

  double speed() const { return limits_.speed; }

 private:
  static constexpr double kArrived = 0.05;  ///< distance at which a point is reached [m]
  /// Larger errors of heading are corrected before it drives [rad].
  static constexpr double kFacing = 0.35;

  DriveLimits limits_;
};

inline const PlayerOption kSpeedOption{"speed_m_s", "m/s", "as fast as its drive can",
                                       "how fast it drives at most"};

inline std::optional<double> speedOption(const Parameters& p) {
  if (!p.has("speed_m_s")) return std::nullopt;
  return p.number("speed_m_s", {0.0, 100.0});
}

inline DriveLimits limitsOf(const PlayerSeat& seat, const std::optional<double>& speed) {
  DriveLimits limits = seat.abilities().limits;
  if (speed) limits.speed = std::min(limits.speed, *speed);
  return limits;
}

/// Returns the robot's true pose. @throws std::runtime_error without a stage or if it is not on it
inline Pose2 poseOf(PlayerSeat& seat) {
  if (seat.stage() != nullptr)
    for (const StagedRobot& robot : seat.stage()->robots())
      if (robot.name == seat.name()) return robot.pose;
  throw std::runtime_error("the robot is on no stage");
}

}  // namespace ortung

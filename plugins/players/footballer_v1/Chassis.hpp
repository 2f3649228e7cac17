#pragma once

// FROZEN, a part of the team footballer-v1: docs/matches.md tells why. Never changed; improvements
// are made in the players of today.

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "Plane.hpp"
#include "ortung/base/Angles.hpp"
#include "ortung/sim_api/Player.hpp"

namespace ortung {

/// Three wheels that roll freely along their axles, as the drive `omni` has them.
struct WheelPlaces {
  std::array<double, 3> angles{};  ///< angles of the wheels around the robot [rad]
  double radius = 0.2;             ///< distance of the wheels from its middle [m]

  /// Returns the speeds at the rims [m/s] for a velocity in the robot frame [m/s], [rad/s].
  std::array<double, 3> speeds(const FloorPoint& velocity, double turn) const {
    std::array<double, 3> wheels{};
    for (std::size_t i = 0; i < wheels.size(); ++i)
      wheels[i] =
          -std::sin(angles[i]) * velocity.x + std::cos(angles[i]) * velocity.y + radius * turn;
    return wheels;
  }
};

inline const PlayerOption kWheelAnglesOption{"wheel_angles_deg", "a,b,c in deg", "60,180,300",
                                             "wheel angles of a robot on three wheels"};
inline const PlayerOption kWheelDistanceOption{"wheel_distance_m", "m", "0.2",
                                               "distance of these wheels from its middle"};

/// Reads both. @throws ConfigError
inline WheelPlaces wheelsOption(const Parameters& p) {
  WheelPlaces wheels;
  const auto angles = p.numbersOr("wheel_angles_deg", {60.0, 180.0, 300.0}, 3, {-360.0, 360.0});
  for (std::size_t i = 0; i < wheels.angles.size(); ++i) wheels.angles.at(i) = radians(angles[i]);
  wheels.radius = p.numberOr("wheel_distance_m", wheels.radius, {0.01, 10.0});
  return wheels;
}

/// Moves a robot as its kind of drive can: with three wheels in any direction while it turns;
/// others turn into the direction of motion.
class Chassis {
 public:
  /// @param wheels nothing: it can't move sideways
  Chassis(const DriveLimits& limits, const std::optional<WheelPlaces>& wheels)
      : limits_(limits), wheels_(wheels) {}

  const DriveLimits& limits() const { return limits_; }
  bool isOmni() const { return wheels_.has_value(); }

  /// Moves the robot. @param velocity velocity in the field frame [m/s] @param heading wanted
  /// heading [rad]
  void move(const Pose2& pose, const FloorPoint& velocity, double heading,
            RobotCommands& robot) const {
    const double speed = std::min(lengthOf(velocity), limits_.speed);
    if (wheels_) {
      const FloorPoint inRobot = speed * towards(wrapAngle(angleOf(velocity) - pose.theta));
      const auto wheels = wheels_->speeds(inRobot, turnFor(wrapAngle(heading - pose.theta)));
      robot.setMotion(wheels);
      return;
    }
    constexpr double kMoves = 0.05;  // [m/s]
    const double wanted = speed > kMoves ? angleOf(velocity) : heading;
    const double error = wrapAngle(wanted - pose.theta);
    robot.setRotationalVelocity(turnFor(error));
    robot.setTranslationalVelocity(speed * std::max(1.0 - std::abs(error) / kFacing, 0.0));
  }
  /// Drives forward and turns, as any drive can [m/s], [rad/s].
  void drive(double ahead, double turn, RobotCommands& robot) const {
    if (wheels_) {
      robot.setMotion(wheels_->speeds({ahead, 0.0}, turn));
      return;
    }
    robot.setRotationalVelocity(turn);
    robot.setTranslationalVelocity(ahead);
  }
  void stand(RobotCommands& robot) const { drive(0.0, 0.0, robot); }

  /// Returns the greatest speed from which half the acceleration still stops the robot in time (v^2
  /// = 2 a s).
  double speedFor(double distance) const {
    return std::min(limits_.speed, std::sqrt(limits_.acceleration * std::max(distance, 0.0)));
  }
  double turnFor(double error) const {
    const double turn = std::min({limits_.turn, 5.0 * std::abs(error),
                                  std::sqrt(limits_.turnAcceleration * std::abs(error))});
    return error < 0.0 ? -turn : turn;
  }

 private:
  /// Larger errors of heading are corrected before it drives [rad].
  static constexpr double kFacing = 1.1;

  DriveLimits limits_;
  std::optional<WheelPlaces> wheels_;
};

}  // namespace ortung

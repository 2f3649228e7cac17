#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "ortung/base/Export.hpp"
#include "ortung/base/Parameters.hpp"
#include "ortung/base/Pose2.hpp"
#include "ortung/base/Random.hpp"
#include "ortung/core/RobotCommands.hpp"
#include "ortung/sim_api/Abi.hpp"
#include "ortung/sim_api/Twist.hpp"

namespace ortung {

/// The limits of a drive, with which drivers and players plan.
struct DriveLimits {
  double speed = 0.8;             ///< greatest translational speed [m/s]
  double turn = 2.0;              ///< greatest turn rate [rad/s]
  double acceleration = 1.0;      ///< greatest translational acceleration [m/s^2]
  double turnAcceleration = 6.0;  ///< greatest angular acceleration [rad/s^2]
};

/// The simulation half of a motion plugin: how a robot's base answers to commands (paper, section
/// 4). Its other half, which MCL uses, is MotionModel. Its constructor takes [drive] of the robot
/// file, of which the simulator itself reads `plugin` and `body_height_m`.
/// In each cycle the simulator calls relocate(), lets the physics try to move the body accordingly,
/// calls setVelocity() if something was in the way, and then measure() with the motion that
/// resulted. Not thread-safe.
class ORTUNG_API Drive {
 public:
  static constexpr const char* kInterface = "ortung.Drive/" ORTUNG_SIM_API_ABI;
  virtual ~Drive();

  // --- commands; a drive keeps to its own limits. All numbers are finite. ---
  /// Commands a velocity along the robot's x axis [m/s]; a drive clamps it to its limits.
  virtual void setTranslationalVelocity(double metresPerSecond) = 0;
  /// Commands a turn rate [rad/s], positive counter-clockwise.
  virtual void setRotationalVelocity(double radiansPerSecond) = 0;
  /// Sets the command vector of this kind of drive, e.g. the speeds of its wheels.
  /// @pre command.size() == commandSize()
  virtual void setCommand(std::span<const double> command) = 0;
  /// Returns how many numbers setCommand() takes.
  virtual std::size_t commandSize() const = 0;
  /// What those numbers are, for programs: 1 to 64 of [a-z0-9_], one of motion:: or a new one. Who
  /// knows a kind can command any drive of it.
  virtual std::string kind() const = 0;
  /// One line on what the numbers of the command vector mean, with units, for people alone.
  virtual std::string commandHelp() const = 0;
  /// Returns what the base can do at most.
  virtual DriveLimits limits() const = 0;

  // --- for the physics ---
  /// Advances the drive by @p dt [s] and returns the change of pose, in the robot's old frame, that
  /// results if nothing is in the way.
  /// @param noise random numbers for errors of the motion itself (slipping wheels); nullptr: none
  virtual Pose2 relocate(double dt, Random* noise) = 0;
  /// Returns the velocity of the base, in the robot frame, at the end of the last relocate(),
  /// without that call's noise, or the velocity set by setVelocity() since. Noise in it would come
  /// back through setVelocity() whenever something touches the robot, and grow.
  virtual Twist velocity() const = 0;
  /// Sets the velocity, in the robot frame, that the robot has after something pushed or held it.
  /// The drive clamps it to its limits.
  virtual void setVelocity(const Twist& velocity) = 0;

  // --- for odometry ---
  /// Returns what odometry measures of the last cycle's true change of pose, in the robot's old
  /// frame.
  /// @param noise random numbers of the odometry errors; nullptr: none
  virtual Pose2 measure(const Pose2& trueChange, Random* noise) = 0;
  /// Returns the velocity that odometry reports; without noise the true one.
  virtual Twist measuredVelocity(bool noise) const;
  /// Returns data about the drive's inner state for the client, at most 16 words (OdometryData).
  virtual std::span<const std::uint32_t> motionData() const;
  /// Returns one line on what those words mean.
  virtual std::string motionDataHelp() const;
};

}  // namespace ortung

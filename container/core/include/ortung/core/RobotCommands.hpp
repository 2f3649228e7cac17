#pragma once

#include <span>
#include <string_view>

#include "ortung/base/Export.hpp"

namespace ortung {

/// Kinds of command vectors that come with Ortung: what the numbers of setMotion() are.
namespace motion {
inline constexpr const char* kDifferential = "differential";  ///< left, right wheel [m/s]
inline constexpr const char* kOmni3 =
    "omni3";  ///< three wheels at the rim, counter-clockwise [m/s]
inline constexpr const char* kVelocities = "velocities";  ///< forwards [m/s], turning left [rad/s]
}  // namespace motion

/// The commands that a robot takes (paper, section 3): a simulated one, one on the field of a
/// server, or a real one. A command holds until the next one; the robot keeps to its own limits.
///
/// All commands throw std::invalid_argument for what this robot does not have or numbers that it
/// can't take, naming the robot and what it has instead, and other std::runtime_errors if the robot
/// can't be reached. What is refused changes nothing.
/// The class that implements it says whether it is thread-safe.
class ORTUNG_API RobotCommands {
 public:
  virtual ~RobotCommands();

  /// @param metresPerSecond velocity along the robot's x axis, positive: forwards [m/s]
  virtual void setTranslationalVelocity(double metresPerSecond) = 0;
  /// @param radiansPerSecond counter-clockwise [rad/s]
  virtual void setRotationalVelocity(double radiansPerSecond) = 0;
  /// Sets the command vector of the robot's kind of motion, e.g. the speeds of its wheels.
  virtual void setMotion(std::span<const double> command) = 0;
  /// @param state name of a state, or its number from 0
  virtual void setManipulator(std::string_view manipulator, std::string_view state) = 0;
};

}  // namespace ortung

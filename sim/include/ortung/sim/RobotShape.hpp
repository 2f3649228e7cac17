#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "ortung/base/Export.hpp"
#include "ortung/robot/RobotFile.hpp"
#include "ortung/sim/Primitive.hpp"
#include "ortung/sim_api/World.hpp"

namespace ortung {

/// A state that a manipulator can be in.
struct ManipulatorState {
  std::string name;
  std::vector<Primitive> pieces;  ///< its pieces in the robot frame; may be none
  double ballSpeed = 0.0;         ///< speed, relative to the robot, that a ball in reach gets [m/s]
  double direction = 0.0;         ///< direction of the kick in the robot frame [rad]
  /// Time until it returns to the first state [s]; none: it stays.
  std::optional<double> returnsAfter;
};

/// A variable part of a robot's geometry (paper, section 2.1): a kicker, flaps to dribble.
struct Manipulator {
  std::string name;
  std::vector<ManipulatorState> states;  ///< its states; the first is the initial one

  /// Returns the index of a state; nothing if there is none of this name.
  ORTUNG_API std::optional<std::size_t> find(std::string_view state) const;
};

/// The body of a simulated robot, from [robot], [[body]] and [[manipulator]] of its file.
struct RobotShape {
  std::string name;
  std::string colour;
  double mass = 10.0;             ///< mass [kg]
  double height = 0.5;            ///< height of the pieces without heights of their own [m]
  std::vector<Primitive> pieces;  ///< pieces in the robot frame, without those of manipulators
  std::vector<Manipulator> manipulators;

  /// Reads the shape from a robot file. @throws ConfigError
  ORTUNG_API static RobotShape read(const RobotConfig& config);
  /// Returns the greatest height of the robot over all states of its manipulators [m].
  ORTUNG_API double top() const;
  /// Returns the greatest number of convex parts over all states of its manipulators; an ellipse
  /// that is not a circle has eight.
  ORTUNG_API std::size_t parts() const;
  /// Returns all pieces with the manipulators in these states. @pre one state for each manipulator
  ORTUNG_API std::vector<Primitive> piecesWith(std::span<const std::size_t> states) const;
};

/// Returns the size of a robot from its file. @throws ConfigError
ORTUNG_API RobotSize sizeOf(const RobotConfig& config);

}  // namespace ortung

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

/// One of the ways in which a manipulator can be set.
struct ManipulatorState {
  std::string name;
  std::vector<Primitive> pieces;       ///< in the robot frame; may be none
  double ballSpeed = 0.0;              ///< a ball in reach gets this, seen from the robot [m/s]
  double direction = 0.0;              ///< towards here, in the robot frame [rad]
  std::optional<double> returnsAfter;  ///< to the first state [s]; none: stays
};

/// A variable part of a robot's geometry (paper, section 2.1): a kicker, flaps to dribble.
struct Manipulator {
  std::string name;
  std::vector<ManipulatorState> states;  ///< the first is that of the beginning

  /// Place of a state, or nothing.
  ORTUNG_API std::optional<std::size_t> find(std::string_view state) const;
};

/// What a simulated robot is made of, from [robot], [[body]] and [[manipulator]] of its file.
struct RobotShape {
  std::string name;
  std::string colour;
  double mass = 10.0;             ///< [kg]
  double height = 0.5;            ///< [m]
  std::vector<Primitive> pieces;  ///< in the robot frame, without manipulators
  std::vector<Manipulator> manipulators;

  /// @throws ConfigError
  ORTUNG_API static RobotShape read(const RobotConfig& config);
  /// The height that the robot may reach, whatever its manipulators do [m].
  ORTUNG_API double top() const;
  /// How many convex parts it may have at a time, whatever its manipulators do; an ellipse that is
  /// no circle has eight.
  ORTUNG_API std::size_t parts() const;
  /// All pieces with the manipulators in these states. @pre one state for each manipulator
  ORTUNG_API std::vector<Primitive> piecesWith(std::span<const std::size_t> states) const;
};

/// The room that a robot takes. @throws ConfigError
ORTUNG_API RobotSize sizeOf(const RobotConfig& config);

}  // namespace ortung

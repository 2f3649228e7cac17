#pragma once

#include "ortung/base/Export.hpp"
#include "ortung/base/Parameters.hpp"

namespace ortung {

/// [physics] of a world file: how bodies move and meet.
struct PhysicsConfig {
  double cycle = 0.01;       ///< `cycle_ms`: cycle of the simulation [s]
  double friction = 0.3;     ///< `friction`: coefficient between bodies that touch; 0: none
  double restitution = 0.3;  ///< `restitution`: e of Newton's hypothesis (paper, eq. 5)
  /// `floor_friction`: coefficient of wheels and of bodies that slide on the floor.
  double floorFriction = 0.7;
  /// `rolling_resistance`: coefficient of balls; times 9.81 m/s^2 it is their deceleration.
  double rollingResistance = 0.03;

  /// Reads the table [physics]. @throws ConfigError, also for unknown keys
  ORTUNG_API static PhysicsConfig read(const Parameters& physics);
};

inline constexpr double kGravity = 9.81;  ///< gravitational acceleration [m/s^2]

}  // namespace ortung

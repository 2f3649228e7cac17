#pragma once

#include "ortung/base/Export.hpp"
#include "ortung/base/Parameters.hpp"

namespace ortung {

/// [physics] of a world file: how bodies move and meet.
struct PhysicsConfig {
  double cycle = 0.01;              ///< `cycle_ms`: of the simulation [s]
  double friction = 0.3;            ///< `friction`: between bodies that touch, 0: none
  double restitution = 0.3;         ///< `restitution`: e of Newton's hypothesis (paper, eq. 5)
  double floorFriction = 0.7;       ///< `floor_friction`: of wheels and what slides on the floor
  double rollingResistance = 0.03;  ///< `rolling_resistance`: of balls; times 9.81 m/s^2, a braking

  /// @throws ConfigError also for keys it does not know
  ORTUNG_API static PhysicsConfig read(const Parameters& physics);
};

inline constexpr double kGravity = 9.81;  ///< [m/s^2]

}  // namespace ortung

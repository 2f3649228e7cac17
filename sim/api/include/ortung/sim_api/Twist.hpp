#pragma once

namespace ortung {

/// A velocity in the plane: of a point [m/s] and of turning [rad/s]. In the robot frame unless its
/// name says otherwise.
struct Twist {
  double x = 0.0;      ///< [m/s]
  double y = 0.0;      ///< [m/s]
  double theta = 0.0;  ///< [rad/s]
};

}  // namespace ortung

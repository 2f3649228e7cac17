#pragma once

namespace ortung {

/// A velocity in the plane: translation [m/s] and turn rate [rad/s]. It is given in the robot frame
/// unless its name says otherwise.
struct Twist {
  double x = 0.0;      ///< [m/s]
  double y = 0.0;      ///< [m/s]
  double theta = 0.0;  ///< [rad/s]
};

}  // namespace ortung

#pragma once

#include "ortung/base/Export.hpp"

namespace ortung {

/// A pose in the plane; it is in the field frame unless its name says otherwise.
/// The field frame has its origin at the field's centre (or the map's own origin), x towards the
/// opponent's goal, y to the left, angles counter-clockwise. Three plain doubles: the layout is
/// part of the plugin ABI and must not depend on compiler flags.
struct Pose2 {
  double x = 0.0;      ///< [m]
  double y = 0.0;      ///< [m]
  double theta = 0.0;  ///< [rad], in (-pi, pi] after every operation below
};

/// Brings an angle into (-pi, pi]. NaN stays NaN.
ORTUNG_API double wrapAngle(double angle);

/// Chains frames (field <- robot <- sensor): returns the pose @p inner, which is given in the frame
/// of @p outer, in the frame that @p outer is given in.
ORTUNG_API Pose2 operator*(const Pose2& outer, const Pose2& inner);

/// Returns the pose p^-1 with p * p^-1 = (0, 0, 0).
ORTUNG_API Pose2 inverse(const Pose2& pose);

/// Returns the distance between the two positions [m].
ORTUNG_API double distance(const Pose2& a, const Pose2& b);

/// Returns whether all three numbers are finite.
ORTUNG_API bool isFinite(const Pose2& pose);

}  // namespace ortung

#pragma once

#include <array>

namespace ortung {

/// Covariance of the error of a pose (x [m], y [m], theta [rad]), row-major and symmetric, along
/// the axes of the frame that the pose is in. A plain array: the layout is part of the plugin ABI,
/// and Eigen maps it in place.
using PoseCovariance = std::array<double, 9>;

/// Returns the covariance of independent errors with these variances [m^2], [m^2], [rad^2].
constexpr PoseCovariance independent(double x, double y, double theta) {
  return {x, 0.0, 0.0, 0.0, y, 0.0, 0.0, 0.0, theta};
}

/// Returns the mean square of the distance from the mean [m^2].
constexpr double positionVariance(const PoseCovariance& covariance) {
  return covariance[0] + covariance[4];
}

/// Returns the variance of the heading [rad^2].
constexpr double headingVariance(const PoseCovariance& covariance) { return covariance[8]; }

/// Adds errors that are independent of those so far.
/// @param position variance along either axis [m^2] @param heading [rad^2]
constexpr void addVariances(PoseCovariance& covariance, double position, double heading) {
  covariance[0] += position;
  covariance[4] += position;
  covariance[8] += heading;
}

}  // namespace ortung

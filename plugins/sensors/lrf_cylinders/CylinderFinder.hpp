#pragma once

#include <span>
#include <vector>

namespace ortung {

/// The appearance of a cylinder in a scan.
struct CylinderLooks {
  double radius = 0.05;        ///< radius [m]
  double breakDistance = 0.1;  ///< least distance of its background behind it [m]
  double tolerance = 0.025;    ///< greatest RMS deviation of its points from the circle [m]
  int leastBeams = 3;
};

/// The axis of an upright cylinder in the scanner's frame.
struct Cylinder {
  double range = 0.0;    ///< distance of the axis [m]
  double bearing = 0.0;  ///< bearing of the axis [rad]
};

/// Finds cylinders of a known radius in a scan: runs of beams that are nearer than both neighbours,
/// have the width of a cylinder at that range, and lie on a circle of that radius, which is fitted
/// by the Gauss-Newton method.
/// @param ranges ranges [m]; NaN: not valid; +infinity: nothing within range
/// @param firstAngle, angleStep angles of the beams [rad]
std::vector<Cylinder> findCylinders(std::span<const float> ranges, double firstAngle,
                                    double angleStep, const CylinderLooks& looks);

}  // namespace ortung

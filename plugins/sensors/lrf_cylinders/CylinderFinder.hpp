#pragma once

#include <span>
#include <vector>

namespace ortung {

/// What a cylinder looks like in a scan.
struct CylinderLooks {
  double radius = 0.05;        ///< [m]
  double breakDistance = 0.1;  ///< what is behind it is farther by at least so much [m]
  double tolerance = 0.025;    ///< how far off its round its points may be, RMS [m]
  int leastBeams = 3;
};

/// The axis of an upright cylinder in the scanner's frame.
struct Cylinder {
  double range = 0.0;    ///< [m]
  double bearing = 0.0;  ///< [rad]
};

/// Cylinders of a known radius in a scan: runs of beams that are nearer than both neighbours, as
/// wide as one is at that range, which lie on a circle of that radius. The circle is fitted by
/// Gauss and Newton's method.
/// @param ranges [m]; NaN: not valid; +infinity: nothing within range
/// @param firstAngle, angleStep of the beams [rad]
std::vector<Cylinder> findCylinders(std::span<const float> ranges, double firstAngle,
                                    double angleStep, const CylinderLooks& looks);

}  // namespace ortung

#pragma once

#include <optional>
#include <vector>

#include "ortung/base/Export.hpp"
#include "ortung/sim_api/World.hpp"

/// Rays in the plane, intersected in closed form: for lines painted on the floor, and for sensors
/// that need no third dimension. World::castFan() casts rays among bodies.
namespace ortung {

/// A ray on the floor in the field frame.
struct Ray2 {
  double x = 0.0;   ///< x of the origin [m]
  double y = 0.0;   ///< y of the origin [m]
  double dx = 1.0;  ///< x of the unit direction
  double dy = 0.0;  ///< y of the unit direction
};

/// Returns the ray from (x, y) [m] along @p angle [rad].
ORTUNG_API Ray2 rayAlong(double x, double y, double angle);

/// Returns the range at which a ray meets the straight line between two points [m]; nothing if it
/// misses it or is parallel to it.
ORTUNG_API std::optional<double> rangeToSegment(const Ray2& ray, double x0, double y0, double x1,
                                                double y1);

/// Returns the ranges at which a ray meets a circle's outline [m], the nearer first: none, one (if
/// the origin is inside) or two.
ORTUNG_API std::vector<double> rangesToCircle(const Ray2& ray, double x, double y, double radius);

/// Appends the ranges [m], not sorted, at which a ray crosses the centre line of a painted line.
/// Rays that cross a filled spot meet it once, at its middle.
ORTUNG_API void addCrossings(const Ray2& ray, const FieldLine& line, std::vector<double>& ranges);

/// Returns a lower bound of the distance from (x, y) to the centre line of a painted line [m].
ORTUNG_API double leastRange(double x, double y, const FieldLine& line);

}  // namespace ortung

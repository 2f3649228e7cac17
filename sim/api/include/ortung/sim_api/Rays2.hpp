#pragma once

#include <optional>
#include <vector>

#include "ortung/base/Export.hpp"
#include "ortung/sim_api/World.hpp"

/// Rays in the plane, in closed form: for what is painted on the floor, and for sensors that need
/// no third dimension. Rays among bodies are World::castFan.
namespace ortung {

/// A ray on the floor, in the field frame.
struct Ray2 {
  double x = 0.0;   ///< origin [m]
  double y = 0.0;   ///< [m]
  double dx = 1.0;  ///< direction, of length 1
  double dy = 0.0;
};

/// The ray from (x, y) along @p angle [rad].
ORTUNG_API Ray2 rayAlong(double x, double y, double angle);

/// Range at which a ray meets the straight line between two points [m]; nothing if it passes or
/// runs parallel.
ORTUNG_API std::optional<double> rangeToSegment(const Ray2& ray, double x0, double y0, double x1,
                                                double y1);

/// Ranges at which a ray meets a circle's outline, the nearer first: none, one (from within, or
/// with the other behind) or two.
ORTUNG_API std::vector<double> rangesToCircle(const Ray2& ray, double x, double y, double radius);

/// Adds the ranges, not sorted, at which a ray crosses the middle of a painted line. A filled spot
/// is met once, at its middle, by rays that cross it.
ORTUNG_API void addCrossings(const Ray2& ray, const FieldLine& line, std::vector<double>& ranges);

/// No point of a painted line's middle is nearer to (x, y) than this [m].
ORTUNG_API double leastRange(double x, double y, const FieldLine& line);

}  // namespace ortung

#pragma once

#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include "ortung/base/Export.hpp"

namespace ortung {

/// A point of the plane, in whatever frame.
struct PlanePoint {
  double x = 0.0;  ///< [m]
  double y = 0.0;  ///< [m]
};

inline double distance(const PlanePoint& a, const PlanePoint& b) {
  return std::hypot(a.x - b.x, a.y - b.y);
}

/// A straight piece of an outline, in the outline's direction.
struct StraightPiece {
  PlanePoint from;
  PlanePoint to;
  std::vector<PlanePoint> points;  ///< of the outline
};

struct StraightPiecesConfig {
  double tolerance = 0.08;  ///< points of one piece are within it of a straight line [m]
  double shortest = 0.5;    ///< shorter pieces are left out [m]
  int fewestPoints = 3;     ///< pieces of fewer points are left out
};

/// Splits an outline into straight pieces, where a point is farthest from the chord (Ramer 1972,
/// Douglas and Peucker 1973); each is a total least squares line.
ORTUNG_API std::vector<StraightPiece> straightPiecesOf(std::span<const PlanePoint> outline,
                                                       const StraightPiecesConfig& config);

/// Where an outline bends: the point farthest from its chord, or 0 if all are within @p tolerance
/// [m]. An outline that comes back to where it began has no chord worth the name: there, the
/// farthest from its beginning.
ORTUNG_API std::size_t bendOf(std::span<const PlanePoint> outline, double tolerance);

}  // namespace ortung

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

/// Returns the distance between two points [m].
inline double distance(const PlanePoint& a, const PlanePoint& b) {
  return std::hypot(a.x - b.x, a.y - b.y);
}

/// A straight piece of an outline, in the outline's direction.
struct StraightPiece {
  PlanePoint from;
  PlanePoint to;
  std::vector<PlanePoint> points;  ///< points of the outline that the piece fits, in its order
};

/// What counts as a straight piece.
struct StraightPiecesConfig {
  double tolerance = 0.08;  ///< points of one piece are within it of a straight line [m]
  double shortest = 0.5;    ///< shorter pieces are left out [m]
  int fewestPoints = 3;     ///< pieces of fewer points are left out
};

/// Splits an outline into straight pieces, where a point is farthest from the chord (Ramer 1972,
/// Douglas and Peucker 1973); each is a total least squares line.
ORTUNG_API std::vector<StraightPiece> straightPiecesOf(std::span<const PlanePoint> outline,
                                                       const StraightPiecesConfig& config);

/// Returns where an outline bends: the index of the point farthest from its chord, or 0 if all are
/// within @p tolerance [m]. Of an outline that comes back to its beginning, which has no usable
/// chord, it is the point farthest from the beginning.
ORTUNG_API std::size_t bendOf(std::span<const PlanePoint> outline, double tolerance);

}  // namespace ortung

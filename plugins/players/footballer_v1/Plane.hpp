#pragma once

// FROZEN, a part of the team footballer-v1: docs/matches.md tells why. Never changed; improvements
// are made in the players of today.

#include <algorithm>
#include <cmath>

#include "ortung/base/Pose2.hpp"
#include "ortung/sim_api/World.hpp"

namespace ortung {

// Points and vectors in the plane [m].
inline FloorPoint operator+(const FloorPoint& a, const FloorPoint& b) {
  return {a.x + b.x, a.y + b.y};
}
inline FloorPoint operator-(const FloorPoint& a, const FloorPoint& b) {
  return {a.x - b.x, a.y - b.y};
}
inline FloorPoint operator*(double factor, const FloorPoint& a) {
  return {factor * a.x, factor * a.y};
}
inline double dot(const FloorPoint& a, const FloorPoint& b) { return a.x * b.x + a.y * b.y; }
inline double lengthOf(const FloorPoint& a) { return std::hypot(a.x, a.y); }
inline double angleOf(const FloorPoint& a) { return std::atan2(a.y, a.x); }
inline FloorPoint towards(double angle) { return {std::cos(angle), std::sin(angle)}; }
inline FloorPoint placeOf(const Pose2& pose) { return {pose.x, pose.y}; }
/// Returns the unit vector in the direction of @p a; (1, 0) for a zero vector.
inline FloorPoint unit(const FloorPoint& a) {
  const double length = lengthOf(a);
  return length > 0.0 ? FloorPoint{a.x / length, a.y / length} : FloorPoint{1.0, 0.0};
}
/// Returns the distance of a point from the segment from @p from to @p to [m].
inline double distanceToWay(const FloorPoint& point, const FloorPoint& from, const FloorPoint& to) {
  const FloorPoint way = to - from;
  const double square = dot(way, way);
  const double share = square > 0.0 ? std::clamp(dot(point - from, way) / square, 0.0, 1.0) : 0.0;
  return lengthOf(point - (from + share * way));
}

/// A round obstacle.
struct Disc {
  FloorPoint at;        ///< centre [m]
  double radius = 0.0;  ///< radius [m]
};

}  // namespace ortung

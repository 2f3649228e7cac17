#pragma once

#include <algorithm>
#include <cmath>

#include "ortung/base/Pose2.hpp"
#include "ortung/sim_api/World.hpp"

namespace ortung {

// Points and ways in the plane [m].
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
/// Of length 1; towards x if there is no direction.
inline FloorPoint unit(const FloorPoint& a) {
  const double length = lengthOf(a);
  return length > 0.0 ? FloorPoint{a.x / length, a.y / length} : FloorPoint{1.0, 0.0};
}
/// How near a point is to the straight way from @p from to @p to.
inline double distanceToWay(const FloorPoint& point, const FloorPoint& from, const FloorPoint& to) {
  const FloorPoint way = to - from;
  const double square = dot(way, way);
  const double share = square > 0.0 ? std::clamp(dot(point - from, way) / square, 0.0, 1.0) : 0.0;
  return lengthOf(point - (from + share * way));
}

/// Something round that is in the way.
struct Disc {
  FloorPoint at;        ///< [m]
  double radius = 0.0;  ///< [m]
};

}  // namespace ortung

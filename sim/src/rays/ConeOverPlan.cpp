#include "ConeOverPlan.hpp"

#include <algorithm>
#include <limits>

namespace ortung {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

double cross(const Point2& a, const Point2& b) { return a.x * b.y - a.y * b.x; }

bool isInside(std::span<const Point2> outline, const Point2& p) {
  bool left = true;
  bool right = true;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Point2& a = outline[i];
    const Point2& b = outline[(i + 1) % outline.size()];
    const double side = cross({b.x - a.x, b.y - a.y}, {p.x - a.x, p.y - a.y});
    left = left && side >= 0.0;
    right = right && side <= 0.0;
  }
  return left || right;
}

/// Returns the point of an edge that is nearest to the origin.
Point2 nearestOf(const Point2& a, const Point2& b) {
  const double ux = b.x - a.x;
  const double uy = b.y - a.y;
  const double square = ux * ux + uy * uy;
  const double share = square > 0.0 ? std::clamp(-(a.x * ux + a.y * uy) / square, 0.0, 1.0) : 0.0;
  return {a.x + share * ux, a.y + share * uy};
}

}  // namespace

/// At the height of the prism that is nearest to the apex, the cone covers what is within a
/// hyperbola: x > 0, slope^2 x^2 >= y^2 + height^2. That is convex, as is the outline. So the
/// nearest common point is the outline's own, or the hyperbola's own, or one where both meet.
/// Other heights of the prism are farther from the apex, and the cone covers less of them.
double ConeOverPlan::nearest(std::span<const Point2> outline, double height) const {
  const double steep = slope * slope;
  const auto covers = [&](const Point2& p) {
    return p.x > 0.0 && steep * p.x * p.x >= p.y * p.y + height * height;
  };
  const double vertex = height / slope;
  if (isInside(outline, {vertex, 0.0})) return std::hypot(vertex, height);
  double best = kInfinity;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Point2& a = outline[i];
    const Point2& b = outline[(i + 1) % outline.size()];
    const auto take = [&](const Point2& p) { best = std::min(best, p.x * p.x + p.y * p.y); };
    if (const Point2 own = nearestOf(a, b); covers(own)) take(own);
    // Where the edge a + s u crosses the hyperbola: q2 s^2 + 2 q1 s + q0 = 0.
    const double ux = b.x - a.x;
    const double uy = b.y - a.y;
    const double q2 = steep * ux * ux - uy * uy;
    const double q1 = steep * a.x * ux - a.y * uy;
    const double q0 = steep * a.x * a.x - a.y * a.y - height * height;
    const double inside = q1 * q1 - q2 * q0;
    if (!(inside >= 0.0)) continue;
    const double far = q1 > 0.0 ? -q1 - std::sqrt(inside) : -q1 + std::sqrt(inside);
    for (const double s : {q2 != 0.0 ? far / q2 : kInfinity, far != 0.0 ? q0 / far : kInfinity})
      if (s >= 0.0 && s <= 1.0 && a.x + s * ux > 0.0) take({a.x + s * ux, a.y + s * uy});
  }
  return std::sqrt(best + height * height);
}

}  // namespace ortung

#include "RoundGeometry.hpp"

#include <cmath>
#include <limits>

namespace ortung {

RoundGeometry::RoundGeometry(const std::vector<RoundBody>& bodies, const Point2& middle) {
  for (const RoundBody& body : bodies) {
    const double c = std::cos(body.angle);
    const double s = std::sin(body.angle);
    bodies_.push_back({body.centre.x - middle.x, body.centre.y - middle.y, body.zLow, body.zHigh,
                       c / body.halfX, s / body.halfX, -s / body.halfY, c / body.halfY,
                       std::hypot(body.halfX * c, body.halfY * s),
                       std::hypot(body.halfX * s, body.halfY * c)});
  }
}

std::array<std::array<float, 3>, 2> RoundGeometry::boundsOf(std::size_t body) const {
  const Unit& b = bodies_[body];
  // The bounds are slightly enlarged, since the tracer's box test rounds.
  const auto low = [](double middle, double reach) {
    return std::nextafter(static_cast<float>(middle - 1.000001 * reach),
                          -std::numeric_limits<float>::infinity());
  };
  const auto high = [](double middle, double reach) {
    return std::nextafter(static_cast<float>(middle + 1.000001 * reach),
                          std::numeric_limits<float>::infinity());
  };
  return {{{low(b.x, b.reachX), low(b.y, b.reachY), low(b.zLow, 0.0)},
           {high(b.x, b.reachX), high(b.y, b.reachY), high(b.zHigh, 0.0)}}};
}

std::optional<float> RoundGeometry::hit(std::size_t body, const FloatRay& ray) const {
  const Unit& b = bodies_[body];
  const double dx = static_cast<double>(ray.origin[0]) - b.x;
  const double dy = static_cast<double>(ray.origin[1]) - b.y;
  const double ux = static_cast<double>(ray.direction[0]);
  const double uy = static_cast<double>(ray.direction[1]);
  const double px = b.xx * dx + b.xy * dy;
  const double py = b.yx * dx + b.yy * dy;
  const double vx = b.xx * ux + b.xy * uy;
  const double vy = b.yx * ux + b.yy * uy;
  // Inside the unit circle where a t^2 + 2 h t + k < 0.
  const double a = vx * vx + vy * vy;
  const double h = px * vx + py * vy;
  const double k = px * px + py * py - 1.0;
  const double root = h * h - a * k;
  if (a > 0.0 && root < 0.0) return std::nullopt;
  if (a == 0.0 && k > 0.0) return std::nullopt;

  const double z = static_cast<double>(ray.origin[2]);
  const double rise = static_cast<double>(ray.direction[2]);
  double nearest = std::numeric_limits<double>::infinity();
  const auto offer = [&](double t) {
    if (t >= static_cast<double>(ray.from) && t < nearest) nearest = t;
  };
  if (a > 0.0) {
    const double between = std::sqrt(root);
    for (const double t : {(-h - between) / a, (-h + between) / a})
      if (z + t * rise >= b.zLow && z + t * rise <= b.zHigh) offer(t);
  }
  if (rise != 0.0) {
    for (const double level : {b.zLow, b.zHigh}) {
      const double t = (level - z) / rise;
      if ((a * t + 2.0 * h) * t + k <= 0.0) offer(t);
    }
  }
  const auto t = static_cast<float>(nearest);
  if (!(t <= ray.to)) return std::nullopt;
  return t;
}

}  // namespace ortung

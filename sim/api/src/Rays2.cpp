#include "ortung/sim_api/Rays2.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "ortung/base/Angles.hpp"

namespace ortung {
namespace {

/// The roots of a t^2 + 2 b t + c in ascending order.
struct Roots {
  int count = 0;
  std::array<double, 2> at{};
};

Roots rootsOf(double a, double b, double c) {
  const double inside = b * b - a * c;
  if (!(a > 0.0) || !(inside >= 0.0)) return {};
  // The root of larger magnitude comes first: subtracting nearly equal numbers loses digits.
  const double far = b > 0.0 ? -b - std::sqrt(inside) : -b + std::sqrt(inside);
  const double other = far == 0.0 ? 0.0 : c / far;
  return {2, {std::min(far / a, other), std::max(far / a, other)}};
}

bool isSpot(const FieldLine& arc) { return std::max(arc.radiusX, arc.radiusY) <= arc.width; }

void addSpot(const Ray2& ray, const FieldLine& spot, std::vector<double>& ranges) {
  const double x = spot.x - ray.x;
  const double y = spot.y - ray.y;
  const double along = x * ray.dx + y * ray.dy;
  const double reach = std::max(spot.radiusX, spot.radiusY) + spot.width / 2.0;
  if (along > 0.0 && std::abs(x * ray.dy - y * ray.dx) <= reach) ranges.push_back(along);
}

void addArc(const Ray2& ray, const FieldLine& arc, std::vector<double>& ranges) {
  if (!(arc.radiusX > 0.0 && arc.radiusY > 0.0)) return;
  // Most rays miss it, which can be tested without a rotation.
  constexpr double kHair = 1.000001;
  const double aside = (arc.x - ray.x) * ray.dy - (arc.y - ray.y) * ray.dx;
  if (std::abs(aside) > kHair * std::max(arc.radiusX, arc.radiusY)) return;
  // In the ellipse's own frame, scaled to a circle of radius 1.
  const double c = std::cos(arc.angle);
  const double s = std::sin(arc.angle);
  const double px = (c * (ray.x - arc.x) + s * (ray.y - arc.y)) / arc.radiusX;
  const double py = (-s * (ray.x - arc.x) + c * (ray.y - arc.y)) / arc.radiusY;
  const double dx = (c * ray.dx + s * ray.dy) / arc.radiusX;
  const double dy = (-s * ray.dx + c * ray.dy) / arc.radiusY;
  const Roots roots = rootsOf(dx * dx + dy * dy, px * dx + py * dy, px * px + py * py - 1.0);
  for (int i = 0; i < roots.count; ++i) {
    const double range = roots.at[static_cast<std::size_t>(i)];
    if (!(range > 0.0)) continue;
    const double t = std::atan2(py + range * dy, px + range * dx);
    const double beyond = std::fmod(std::fmod(t - arc.from, kTurn) + kTurn, kTurn);
    if (beyond <= arc.to - arc.from) ranges.push_back(range);
  }
}

}  // namespace

Ray2 rayAlong(double x, double y, double angle) { return {x, y, std::cos(angle), std::sin(angle)}; }

std::optional<double> rangeToSegment(const Ray2& ray, double x0, double y0, double x1, double y1) {
  const double ex = x1 - x0;
  const double ey = y1 - y0;
  const double across = ray.dx * ey - ray.dy * ex;
  if (across * across <= 1e-24 * (ex * ex + ey * ey)) return std::nullopt;
  const double dx = x0 - ray.x;
  const double dy = y0 - ray.y;
  const double range = (dx * ey - dy * ex) / across;
  const double share =
      (dx * ray.dy - dy * ray.dx) / across;  // where the ray crosses, as a share of the segment
  if (!(range >= 0.0 && share >= 0.0 && share <= 1.0)) return std::nullopt;
  return range;
}

std::vector<double> rangesToCircle(const Ray2& ray, double x, double y, double radius) {
  const double dx = ray.x - x;
  const double dy = ray.y - y;
  const Roots roots = rootsOf(1.0, dx * ray.dx + dy * ray.dy, dx * dx + dy * dy - radius * radius);
  std::vector<double> ranges;
  for (int i = 0; i < roots.count; ++i)
    if (roots.at[static_cast<std::size_t>(i)] >= 0.0)
      ranges.push_back(roots.at[static_cast<std::size_t>(i)]);
  return ranges;
}

double leastRange(double x, double y, const FieldLine& line) {
  if (line.shape == FieldLine::Shape::kArc) {
    const double radius = std::max(line.radiusX, line.radiusY) + line.width / 2.0;
    return std::max(std::hypot(line.x - x, line.y - y) - radius, 0.0);
  }
  const double ex = line.x1 - line.x0;
  const double ey = line.y1 - line.y0;
  const double length2 = ex * ex + ey * ey;
  const double along = (x - line.x0) * ex + (y - line.y0) * ey;
  const double share = length2 > 0.0 ? std::clamp(along / length2, 0.0, 1.0) : 0.0;
  return std::hypot(line.x0 + share * ex - x, line.y0 + share * ey - y);
}

void addCrossings(const Ray2& ray, const FieldLine& line, std::vector<double>& ranges) {
  if (line.shape == FieldLine::Shape::kStraight) {
    if (const auto range = rangeToSegment(ray, line.x0, line.y0, line.x1, line.y1))
      ranges.push_back(*range);
  } else if (isSpot(line)) {
    addSpot(ray, line, ranges);
  } else {
    addArc(ray, line, ranges);
  }
}

}  // namespace ortung

#include "CylinderFinder.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "ortung/base/Pose2.hpp"

namespace ortung {
namespace {

constexpr int kSteps =
    5;  // steps; from less than a radius off, the third one changes only micrometres
// Bounds of the observed width: edges are grazed or missed, and beams are as wide as steps.
constexpr double kNarrowest = 0.5;  // as a share of the expected width
constexpr double kWidest = 1.3;
constexpr double kBeamsMore = 2.0;

struct Point {
  double x, y;  ///< coordinates [m]
};

/// Returns the centre of the circle of that radius on which the points lie, or nothing.
std::optional<Point> centreOf(const std::vector<Point>& points, Point centre,
                              const CylinderLooks& looks) {
  for (int step = 0; step < kSteps; ++step) {
    double xx = 0.0;
    double xy = 0.0;
    double yy = 0.0;
    double bx = 0.0;
    double by = 0.0;
    for (const Point& p : points) {
      const double distance = std::hypot(p.x - centre.x, p.y - centre.y);
      if (distance == 0.0) return std::nullopt;
      const double ux = (p.x - centre.x) / distance;
      const double uy = (p.y - centre.y) / distance;
      const double off = distance - looks.radius;
      xx += ux * ux;
      xy += ux * uy;
      yy += uy * uy;
      bx += ux * off;
      by += uy * off;
    }
    const double determinant = xx * yy - xy * xy;
    if (!(determinant > 1e-9)) return std::nullopt;
    centre.x += (yy * bx - xy * by) / determinant;
    centre.y += (xx * by - xy * bx) / determinant;
  }
  double squares = 0.0;
  for (const Point& p : points) {
    const double off = std::hypot(p.x - centre.x, p.y - centre.y) - looks.radius;
    squares += off * off;
  }
  const double rms = std::sqrt(squares / static_cast<double>(points.size()));
  return rms <= looks.tolerance ? std::optional(centre) : std::nullopt;  // NaN: nothing
}

/// Returns the cylinder that beams [begin, end) may have hit.
std::optional<Cylinder> cylinderOf(std::span<const float> ranges, std::size_t begin,
                                   std::size_t end, double firstAngle, double angleStep,
                                   const CylinderLooks& looks) {
  const auto nearest =
      static_cast<double>(*std::min_element(ranges.begin() + static_cast<std::ptrdiff_t>(begin),
                                            ranges.begin() + static_cast<std::ptrdiff_t>(end)));
  const double distance = nearest + looks.radius;
  if (!(nearest > 0.0)) return std::nullopt;
  const double width = 2.0 * std::asin(looks.radius / distance) / std::abs(angleStep);  // [beams]
  const auto beams = static_cast<double>(end - begin);
  if (beams < kNarrowest * width || beams > kWidest * width + kBeamsMore) return std::nullopt;
  std::vector<Point> points;
  for (std::size_t i = begin; i < end; ++i) {
    const double angle = firstAngle + static_cast<double>(i) * angleStep;
    const auto range = static_cast<double>(ranges[i]);
    points.push_back({range * std::cos(angle), range * std::sin(angle)});
  }
  const double middle = firstAngle + 0.5 * static_cast<double>(begin + end - 1) * angleStep;
  const auto centre =
      centreOf(points, {distance * std::cos(middle), distance * std::sin(middle)}, looks);
  if (!centre) return std::nullopt;
  return Cylinder{std::hypot(centre->x, centre->y), std::atan2(centre->y, centre->x)};
}

}  // namespace

std::vector<Cylinder> findCylinders(std::span<const float> ranges, double firstAngle,
                                    double angleStep, const CylinderLooks& looks) {
  std::vector<Cylinder> found;
  const auto gap = static_cast<float>(looks.breakDistance);
  // Invalid beams, and the edge of the field of view, may hide something nearer, so they are not
  // behind.
  const auto isBehind = [&](std::size_t beam, float edge) { return ranges[beam] - edge > gap; };
  std::size_t begin = 0;
  for (std::size_t end = 1; end <= ranges.size(); ++end) {
    const bool goesOn = end < ranges.size() && std::abs(ranges[end] - ranges[end - 1]) <= gap;
    if (goesOn) continue;
    const bool isFree = begin > 0 && end < ranges.size() && isBehind(begin - 1, ranges[begin]) &&
                        isBehind(end, ranges[end - 1]);
    if (isFree && end - begin >= static_cast<std::size_t>(looks.leastBeams)) {
      if (const auto one = cylinderOf(ranges, begin, end, firstAngle, angleStep, looks))
        found.push_back(*one);
    }
    begin = end;
  }
  return found;
}

}  // namespace ortung

#include "SurfaceRay.hpp"

#include <algorithm>
#include <cmath>

namespace ortung {
namespace {

constexpr double kStep = 0.5;  ///< distance between places that are checked [cells]
/// Greatest distance between the hit on a cell's line and the mean of the cell's ends: neighbouring
/// cells have ends of their own [cells].
constexpr double kReach = 1.0;
constexpr double kGrazes = 0.05;  ///< sine; a ray along a line meets it where its ends begin

struct Hit {
  double range;
  double off;  ///< distance of the hit from the mean of the cell's ends [m]
};

/// Returns where a ray meets a surface's line; for spots, and lines along the ray, where it is
/// nearest.
Hit meet(const Surface& surface, const Pose2& ray, double c, double s) {
  const double dx = static_cast<double>(surface.x) - ray.x;
  const double dy = static_cast<double>(surface.y) - ray.y;
  const double nx = static_cast<double>(surface.normalX);
  const double ny = static_cast<double>(surface.normalY);
  const double slant = nx * c + ny * s;
  const bool isCrossed = surface.along < 0.0F && std::abs(slant) > kGrazes;
  const double range = isCrossed ? (nx * dx + ny * dy) / slant : dx * c + dy * s;
  return {range, std::hypot(range * c - dx, range * s - dy)};
}

}  // namespace

double rangeAlong(const SurfaceField& surfaces, const Pose2& ray, double maxRange) {
  const double cell = surfaces.grid().cell;
  const double c = std::cos(ray.theta);
  const double s = std::sin(ray.theta);
  double at = 0.0;
  while (at < maxRange) {
    const Surface* surface = surfaces.near(ray.x + at * c, ray.y + at * s);
    if (surface == nullptr) {
      at += SurfaceField::kReach * cell;  // nothing is nearer than that
      continue;
    }
    const Hit hit = meet(*surface, ray, c, s);
    if (hit.range > 0.0 && hit.off < kReach * cell && std::abs(hit.range - at) < 2.0 * cell)
      return hit.range < maxRange ? hit.range : maxRange;
    // The ray may advance by the distance of the nearest surface, less the rounding to a cell.
    const double away = std::hypot(static_cast<double>(surface->x) - ray.x - at * c,
                                   static_cast<double>(surface->y) - ray.y - at * s);
    at += std::max(kStep * cell, away - 1.5 * cell);
  }
  return maxRange;
}

}  // namespace ortung

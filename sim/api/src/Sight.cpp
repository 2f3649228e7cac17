#include "ortung/sim_api/Sight.hpp"

#include <algorithm>
#include <cmath>

#include "ortung/base/Angles.hpp"

namespace ortung {
namespace {

constexpr double kSeen[] = {-0.8, -0.4, 0.0, 0.4, 0.8};  // targets, in half widths of the body
// A body that is not as round as its circle must not hide itself [m].
constexpr double kOwn = 0.02;

/// Returns half of a body's width across a line of sight [m].
double halfWidthAcross(const WorldObject& object, double angle) {
  const double turn = angle - object.pose.theta;
  const double x = object.halfX * std::sin(turn);
  const double y = object.halfY * std::cos(turn);
  return object.isRound ? std::hypot(x, y) : std::abs(x) + std::abs(y);
}

}  // namespace

std::optional<Sighting> lookAt(const Eye& eye, double x, double y) {
  const double dx = x - eye.pose.x;
  const double dy = y - eye.pose.y;
  const Sighting sighting{std::hypot(dx, dy), wrapAngle(std::atan2(dy, dx) - eye.pose.theta)};
  const bool isInView =
      eye.fieldOfView >= kTurn || std::abs(sighting.bearing) <= eye.fieldOfView / 2.0;
  if (!isInView || !(sighting.range >= eye.minRange) || !(sighting.range <= eye.maxRange))
    return std::nullopt;
  return sighting;
}

bool isVisible(const World& world, const Eye& eye, double x, double y, double z, double slack) {
  return world.isVisible(eye.pose.x, eye.pose.y, eye.z, x, y, z, eye.robot, slack);
}

double visibleShare(const World& world, const Eye& eye, const WorldObject& object) {
  const double dx = object.pose.x - eye.pose.x;
  const double dy = object.pose.y - eye.pose.y;
  const double way = std::hypot(dx, dy);
  if (way <= object.radius) return 1.0;  // the eye is inside it or above it
  const double half = halfWidthAcross(object, std::atan2(dy, dx));
  const double z = (object.zLow + object.zHigh) / 2.0;
  // A line of sight from above enters the body through its top, this far before its middle.
  const double drop = std::abs(eye.z - z);
  const double line = std::hypot(way, drop);
  const double side = object.radius * line / way;
  const double own = drop > 0.0 ? std::min(side, (object.zHigh - z) * line / drop) : side;
  int seen = 0;
  for (const double place : kSeen) {
    const double x = object.pose.x - dy / way * place * half;
    const double y = object.pose.y + dx / way * place * half;
    seen += isVisible(world, eye, x, y, z, own + kOwn) ? 1 : 0;
  }
  return static_cast<double>(seen) / static_cast<double>(std::size(kSeen));
}

}  // namespace ortung

#include "ortung/base/Pose2.hpp"

#include <cmath>
#include <numbers>

namespace ortung {

double wrapAngle(double angle) {
  constexpr double kPi = std::numbers::pi;
  if (angle > -kPi && angle <= kPi) return angle;
  const double wrapped = std::remainder(angle, 2 * kPi);
  return wrapped <= -kPi ? kPi : wrapped;
}

Pose2 operator*(const Pose2& outer, const Pose2& inner) {
  const double c = std::cos(outer.theta);
  const double s = std::sin(outer.theta);
  return {outer.x + c * inner.x - s * inner.y, outer.y + s * inner.x + c * inner.y,
          wrapAngle(outer.theta + inner.theta)};
}

Pose2 inverse(const Pose2& pose) {
  const double c = std::cos(pose.theta);
  const double s = std::sin(pose.theta);
  return {-c * pose.x - s * pose.y, s * pose.x - c * pose.y, wrapAngle(-pose.theta)};
}

double distance(const Pose2& a, const Pose2& b) { return std::hypot(a.x - b.x, a.y - b.y); }

bool isFinite(const Pose2& pose) {
  return std::isfinite(pose.x) && std::isfinite(pose.y) && std::isfinite(pose.theta);
}

}  // namespace ortung

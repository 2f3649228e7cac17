#include "TiltHistory.hpp"

#include <algorithm>
#include <cmath>

namespace ortung::ros2 {
namespace {

constexpr double kSteepest = 0.7071;  // cosine of the greatest tilt: 45 degrees

Eigen::Vector3d vectorOf(const std::array<float, 3>& numbers) {
  return Eigen::Vector3f(numbers.data()).cast<double>();
}

/// The rows of the rotation are the axes of the level frame, as the robot sees them: z points up,
/// and x has the robot's heading.
std::optional<Eigen::Matrix3d> levelling(const Eigen::Vector3d& up) {
  if (!(up.z() >= kSteepest)) return std::nullopt;
  Eigen::Matrix3d turn;
  const Eigen::Vector3d ahead = (Eigen::Vector3d::UnitX() - up.x() * up).normalized();
  turn.row(0) = ahead;
  turn.row(1) = up.cross(ahead);
  turn.row(2) = up;
  return turn;
}

}  // namespace

bool TiltHistory::add(Timestamp stamp, const Quaternion& attitude) {
  const Eigen::Quaterniond turn(attitude.w, attitude.x, attitude.y, attitude.z);
  constexpr double kLeast = 1e-3;  // least length of a quaternion, which should be 1
  const double length = turn.norm();
  if (!(length > kLeast) || !std::isfinite(length)) return false;
  const Eigen::Vector3f up =
      (turn.normalized().conjugate() * Eigen::Vector3d::UnitZ()).cast<float>();
  isSorted_ = isSorted_ && (list_.empty() || list_.back().stamp <= stamp);
  list_.push_back({stamp, {up.x(), up.y(), up.z()}});
  if (most_ == 0 || list_.size() < 2 * most_) return true;
  sort();
  list_.erase(list_.begin(), list_.end() - static_cast<std::ptrdiff_t>(most_));
  return true;
}

void TiltHistory::sort() {
  const auto isEarlier = [](const Upright& a, const Upright& b) { return a.stamp < b.stamp; };
  if (!isSorted_) std::stable_sort(list_.begin(), list_.end(), isEarlier);
  isSorted_ = true;
}

std::optional<Eigen::Matrix3d> TiltHistory::at(Timestamp stamp, const Eigen::Matrix3d& unit) {
  sort();
  const auto after =
      std::lower_bound(list_.begin(), list_.end(), stamp,
                       [](const Upright& one, Timestamp wanted) { return one.stamp < wanted; });
  const bool isBefore = after != list_.begin() && stamp - std::prev(after)->stamp <= kLongestGap;
  const bool isAfter = after != list_.end() && after->stamp - stamp <= kLongestGap;
  if (!isBefore && !isAfter) return std::nullopt;
  const Upright& from = isBefore ? *std::prev(after) : *after;
  const Upright& to = isAfter ? *after : from;
  const double share = to.stamp > from.stamp ? static_cast<double>(stamp - from.stamp) /
                                                   static_cast<double>(to.stamp - from.stamp)
                                             : 0.0;
  const Eigen::Vector3d up = (1.0 - share) * vectorOf(from.up) + share * vectorOf(to.up);
  if (!(up.norm() > 0.5)) return std::nullopt;  // between attitudes that contradict each other
  return levelling(unit * up.normalized());
}

}  // namespace ortung::ros2

#include "VelocityHistory.hpp"

#include <algorithm>
#include <cmath>

#include "ortung/base/Angles.hpp"
#include "ortung/realsensors/LogFile.hpp"

namespace ortung::ros2 {

void VelocityHistory::add(Timestamp stamp, const PlanarVelocity& velocity) {
  for (const double number : {velocity.forward, velocity.left, velocity.turn})
    if (!(std::abs(number) <= kMaxLogVelocity)) return;
  isSorted_ = isSorted_ && (list_.empty() || list_.back().first <= stamp);
  list_.emplace_back(stamp, velocity);
  if (most_ == 0 || list_.size() < 2 * most_) return;
  sort();
  list_.erase(list_.begin(), list_.end() - static_cast<std::ptrdiff_t>(most_));
}

void VelocityHistory::addPose(Timestamp stamp, const Pose2& pose) {
  const auto before = std::exchange(last_, std::pair(stamp, pose));
  if (!before || stamp <= before->first || stamp - before->first > kLongest) return;
  const double seconds = toSeconds(stamp - before->first);
  const Pose2 way = inverse(before->second) * pose;
  add(stamp, {way.x / seconds, way.y / seconds, wrapAngle(way.theta) / seconds});
}

void VelocityHistory::sort() {
  const auto isEarlier = [](const auto& a, const auto& b) { return a.first < b.first; };
  if (!isSorted_) std::stable_sort(list_.begin(), list_.end(), isEarlier);
  isSorted_ = true;
}

PlanarVelocity VelocityHistory::at(Timestamp stamp) {
  sort();
  const auto after =
      std::upper_bound(list_.begin(), list_.end(), stamp,
                       [](Timestamp wanted, const auto& one) { return wanted < one.first; });
  const bool isBefore = after != list_.begin() && stamp - std::prev(after)->first <= kLongest;
  const bool isAfter = after != list_.end() && after->first - stamp <= kLongest;
  if (!isBefore && !isAfter) return {};
  const auto& [begin, from] = isBefore ? *std::prev(after) : *after;
  const auto& [end, to] = isAfter ? *after : *std::prev(after);
  if (end <= begin) return from;
  const double share = static_cast<double>(stamp - begin) / static_cast<double>(end - begin);
  return {from.forward + share * (to.forward - from.forward),
          from.left + share * (to.left - from.left), from.turn + share * (to.turn - from.turn)};
}

}  // namespace ortung::ros2

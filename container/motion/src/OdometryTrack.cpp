#include "ortung/motion/OdometryTrack.hpp"

#include <algorithm>
#include <cmath>

namespace ortung {
namespace {

constexpr double kLongestExtrapolation = 0.3;  // [s]

/// Returns the part @p share of a change of pose, along the arc to its end.
Pose2 part(const Pose2& change, double share) {
  // The chord of an arc points along half its turn, and its length is that of the arc times
  // sinc(turn / 2).
  const double half = change.theta / 2.0;
  const double partHalf = share * half;
  const double sincs = std::abs(half) < 1e-6 ? share : std::sin(partHalf) / std::sin(half);
  const double c = sincs * std::cos(partHalf - half);
  const double s = sincs * std::sin(partHalf - half);
  return {c * change.x - s * change.y, s * change.x + c * change.y, share * change.theta};
}

/// Returns the pose of a robot after moving with constant velocities in its own frame [m/s],
/// [rad/s], relative to where it began: along an arc, in any direction.
Pose2 arc(double v, double sideways, double w, double seconds) {
  const double half = w * seconds / 2.0;
  const double chord = seconds * (std::abs(half) < 1e-6 ? 1.0 : std::sin(half) / half);
  const double c = chord * std::cos(half);
  const double s = chord * std::sin(half);
  return {c * v - s * sideways, s * v + c * sideways, 2.0 * half};
}

}  // namespace

OdometryTrack::OdometryTrack(double kept) : kept_(kept) {}

void OdometryTrack::add(Timestamp stamp, const Pose2& pose, double v, double w, double sideways) {
  // If the clock was set back, the track begins anew; of two readings with one stamp the later one
  // stays.
  if (!readings_.empty() && stamp < readings_.back().stamp) readings_.clear();
  if (!readings_.empty() && stamp == readings_.back().stamp) readings_.pop_back();
  readings_.push_back({stamp, pose, v, w, sideways});
  while (readings_.size() > 2 && toSeconds(stamp - readings_[1].stamp) > kept_)
    readings_.pop_front();
}

std::deque<OdometryTrack::Reading>::const_iterator OdometryTrack::behind(Timestamp stamp) const {
  return std::upper_bound(readings_.begin(), readings_.end(), stamp,
                          [](Timestamp t, const Reading& r) { return t < r.stamp; });
}

std::optional<Pose2> OdometryTrack::at(Timestamp stamp) const {
  if (readings_.empty()) return std::nullopt;
  const auto next = behind(stamp);
  if (next == readings_.begin() || next == readings_.end()) {
    const Reading& nearest = next == readings_.begin() ? readings_.front() : readings_.back();
    const double seconds =
        std::clamp(toSeconds(stamp - nearest.stamp), -kLongestExtrapolation, kLongestExtrapolation);
    return nearest.pose * arc(nearest.v, nearest.sideways, nearest.w, seconds);
  }
  const Reading& before = *std::prev(next);
  const double share = toSeconds(stamp - before.stamp) / toSeconds(next->stamp - before.stamp);
  return before.pose * part(inverse(before.pose) * next->pose, share);
}

double OdometryTrack::gapAt(Timestamp stamp) const {
  const auto next = behind(stamp);
  if (next == readings_.begin()) return std::numeric_limits<double>::infinity();
  if (next == readings_.end()) {
    return stamp == readings_.back().stamp ? 0.0 : std::numeric_limits<double>::infinity();
  }
  return toSeconds(next->stamp - std::prev(next)->stamp);
}

}  // namespace ortung

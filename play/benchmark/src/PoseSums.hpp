#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <optional>

#include "ortung/benchmark/GoalEpisodes.hpp"
#include "ortung/sim_api/Twist.hpp"

namespace ortung {

/// A digest of the bits of poses: FNV-1a over their bytes.
class PoseDigest {
 public:
  void add(double value) {
    const auto bits = std::bit_cast<std::uint64_t>(value);
    for (int i = 0; i < 64; i += 8) hash_ = (hash_ ^ ((bits >> i) & 0xff)) * 1099511628211U;
  }
  void add(const Pose2& pose) { add(pose.x), add(pose.y), add(pose.theta); }
  void add(const Twist& twist) { add(twist.x), add(twist.y), add(twist.theta); }
  std::uint32_t value() const { return static_cast<std::uint32_t>(hash_ ^ (hash_ >> 32)); }

 private:
  std::uint64_t hash_ = 14695981039346656037U;
};

/// Compares a player's believed pose with the truth whenever it acts.
class PoseErrors {
 public:
  void add(const std::optional<BelievedPose>& believed, const Pose2& truth, Timestamp now) {
    if (!believed || believed->stamp != now) return;
    ++count_;
    position_ += distance(believed->pose, truth);
    heading_ += std::abs(wrapAngle(believed->pose.theta - truth.theta));
  }
  PoseError mean() const {
    if (count_ == 0) return {};
    return {micro(position_), micro(heading_)};
  }

 private:
  std::int32_t micro(double sum) const {
    return static_cast<std::int32_t>(std::lround(std::min(1e6 * sum / count_, 2e9)));
  }
  double count_ = 0.0;
  double position_ = 0.0;
  double heading_ = 0.0;
};

}  // namespace ortung

#pragma once

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <vector>

#include "Moment.hpp"
#include "ortung/base/Angles.hpp"

namespace ortung::football {

/// Drives to a place, around obstacles.
class Go {
 public:
  /// Returns the direction nearest to the straight one that is free for the next metre; nothing if
  /// there is none. The side on which it passes an obstacle stays the same as long as that costs
  /// little. @param radius the robot's radius [m]
  std::optional<double> direction(const FloorPoint& from, const FloorPoint& to, double radius,
                                  const std::vector<Disc>& discs) {
    const double straight = angleOf(to - from);
    const double ahead = std::min(lengthOf(to - from), kLook);
    const auto isOpen = [&](double angle) {
      return isFree(from, from + ahead * towards(angle), radius, discs);
    };
    if (isOpen(straight)) {
      side_ = 0.0;
      return straight;
    }
    for (int i = 1; i <= kSteps + kLoyal; ++i) {
      for (const double side : {1.0, -1.0}) {
        const int steps = side * side_ < 0.0 ? i - kLoyal : i;
        const double angle = straight + side * steps * kStep;
        if (steps < 1 || steps > kSteps || !isOpen(angle)) continue;
        side_ = side;
        return wrapAngle(angle);
      }
    }
    return std::nullopt;
  }

  /// Drives to a place. @param heading wanted heading there [rad] @param more further obstacles
  void to(const Moment& m, const FloorPoint& target, double heading, double speed,
          const std::vector<Disc>& more = {}) {
    const FloorPoint from = m.view.place();
    const double away = lengthOf(target - from);
    constexpr double kThere = 0.06;  // [m]
    if (away < kThere) return m.chassis.move(m.view.pose, {}, heading, m.robot);
    std::vector<Disc> discs = more;
    for (const Other& other : m.view.others) discs.push_back({foreseen(other, from), other.radius});
    std::copy_if(m.ground.posts.begin(), m.ground.posts.end(), std::back_inserter(discs),
                 [&](const Disc& post) { return lengthOf(post.at - from) < 2.0 * kLook; });
    auto way = direction(from, target, m.view.radius, discs);
    double fast = std::min(speed, m.chassis.speedFor(away));
    if (!way) {  // it is hemmed in, e.g. in a goal behind its keeper: it pushes slowly
      way = angleOf(target - from);
      fast = std::min(fast, kPushes);
    }
    m.chassis.move(m.view.pose, fast * towards(*way), heading, m.robot);
  }

 private:
  static constexpr double kPushes = 0.3;  ///< speed if no way is free [m/s]
  static constexpr double kLook = 1.2;    ///< how far ahead the path must be free [m]
  static constexpr double kStep = 10.0 * kDegree;
  static constexpr int kSteps = 14;     ///< number of steps to either side
  static constexpr int kLoyal = 3;      ///< number of steps by which the other side must be better
  static constexpr double kGap = 0.06;  ///< gap between bodies [m]

  static FloorPoint foreseen(const Other& other, const FloorPoint& from) {
    constexpr double kFast = 2.0;  // [m/s]
    const double time = std::min(lengthOf(other.at - from) / kFast, 0.5);
    return other.at + time * other.velocity;
  }
  /// Returns whether a path is free. An obstacle that it already touches does not keep it from
  /// moving away.
  static bool isFree(const FloorPoint& from, const FloorPoint& to, double radius,
                     const std::vector<Disc>& discs) {
    for (const Disc& disc : discs) {
      const double room = radius + disc.radius + kGap;
      const double now = lengthOf(disc.at - from);
      if (distanceToWay(disc.at, from, to) >= std::min(room, now)) continue;
      if (dot(disc.at - from, to - from) > 0.0) return false;
    }
    return true;
  }

  double side_ = 0.0;  ///< side on which it passes obstacles: 1: left, -1: right, 0: either
};

}  // namespace ortung::football

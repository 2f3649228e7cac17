#pragma once

// FROZEN, a part of the team footballer-v1: docs/matches.md tells why. Never changed; improvements
// are made in the players of today.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>

#include "RollingBall.hpp"
#include "ortung/base/Random.hpp"
#include "ortung/base/Time.hpp"

namespace ortung {

/// How a goalkeeper moves along its line (paper, section 5.1).
enum class KeeperPolicy : std::uint8_t {
  kStill,
  kRandom,
  kPattern,
  kBlocking,
  kIntercepting,
  kMixed
};

/// The line before its goal on which a keeper moves. The frame is the field's.
struct KeeperLine {
  FloorPoint goal;     ///< middle of the goal's mouth [m]
  double x = 0.0;      ///< x of the line [m]
  double reach = 0.8;  ///< how far it moves to either side of the goal's middle [m]

  double within(double y) const { return std::clamp(y, goal.y - reach, goal.y + reach); }
  /// Returns y where the straight line from the ball to the goal's middle crosses the line [m]. A
  /// ball behind the line is treated as one on it.
  double blockingPlace(const FloorPoint& ball) const {
    const double depth = (ball.x - goal.x) * (x > goal.x ? 1.0 : -1.0);
    const double share = std::abs(x - goal.x) / std::max(depth, std::abs(x - goal.x));
    return within(goal.y + share * (ball.y - goal.y));
  }
};

/// Decides where on its line a keeper should be. Deterministic for given random numbers.
class KeeperMind {
 public:
  KeeperMind(KeeperPolicy policy, const KeeperLine& line) : policy_(policy), line_(line) {}

  /// @param y the keeper's place on its line [m]
  /// @param ball the ball; nothing: it was never seen
  /// @returns the wanted place [m]; nothing: it does not move
  std::optional<double> decide(Timestamp now, double y, const std::optional<RollingBall>& ball,
                               Random& random) {
    KeeperPolicy policy = policy_;
    if (policy == KeeperPolicy::kMixed) {
      if (now >= mixedUntil_) {
        constexpr std::array kMix = {KeeperPolicy::kStill, KeeperPolicy::kRandom,
                                     KeeperPolicy::kPattern, KeeperPolicy::kBlocking,
                                     KeeperPolicy::kIntercepting};
        mixed_ = kMix[random.below(kMix.size())];
        mixedUntil_ = now + kMixed;
      }
      policy = mixed_;
    }
    switch (policy) {
      case KeeperPolicy::kRandom:
        return wander(now, y, random);
      case KeeperPolicy::kPattern:
        return swing(y);
      case KeeperPolicy::kBlocking:
        return ball ? line_.blockingPlace(ball->at) : line_.goal.y;
      case KeeperPolicy::kIntercepting:
        return intercept(ball);
      case KeeperPolicy::kStill:
      case KeeperPolicy::kMixed:
        break;
    }
    return std::nullopt;
  }

 private:
  static constexpr Timestamp kMixed = 800'000;  ///< duration of one policy in `mixed` [us]
  static constexpr double kThere = 0.05;        ///< distance at which a place is reached [m]
  static constexpr double kRolls = 0.3;         ///< slower balls count as lying [m/s]

  /// Returns a random place, which changes when it is reached or after some time.
  double wander(Timestamp now, double y, Random& random) {
    if (!target_ || now >= wanderUntil_ || std::abs(*target_ - y) < kThere) {
      target_ = line_.goal.y + random.uniform(-line_.reach, line_.reach);
      wanderUntil_ = now + fromSeconds(random.uniform(0.4, 1.2));
    }
    return *target_;
  }
  /// Returns alternately the ends of its line.
  double swing(double y) {
    if (y >= line_.goal.y + line_.reach - kThere) side_ = -1.0;
    if (y <= line_.goal.y - line_.reach + kThere) side_ = 1.0;
    return line_.goal.y + side_ * line_.reach;
  }
  /// Returns the place where the ball will cross the line; if it will not, the blocking place.
  double intercept(const std::optional<RollingBall>& ball) const {
    if (!ball) return line_.goal.y;
    if (ball->speed() > kRolls)
      if (const auto crossing = ball->crossing(line_.x)) return line_.within(crossing->y);
    return line_.blockingPlace(ball->at);
  }

  KeeperPolicy policy_;
  KeeperLine line_;
  std::optional<double> target_;
  Timestamp wanderUntil_ = 0;
  double side_ = 1.0;
  KeeperPolicy mixed_ = KeeperPolicy::kStill;
  Timestamp mixedUntil_ = 0;
};

}  // namespace ortung

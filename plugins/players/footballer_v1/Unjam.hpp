#pragma once

// FROZEN, a part of the team footballer-v1: docs/matches.md tells why. Never changed; improvements
// are made in the players of today.

#include <cmath>
#include <numbers>

#include "Moment.hpp"
#include "ortung/base/Random.hpp"

namespace ortung::football_v1 {

/// Detects that a robot wants to move but does not, and frees it by driving back and to one side.
class Unjam {
 public:
  /// Frees the robot if it is stuck. @returns whether it did, instead of the planned action @param
  /// wantsToMove whether the robot wants to move now
  bool act(const Moment& m, bool wantsToMove, Random& random) {
    if (m.view.now < until_) {
      m.hands.hold(false, m.robot);
      if (m.chassis.isOmni()) {
        m.chassis.move(m.view.pose, 0.8 * towards(away_), m.view.pose.theta, m.robot);
      } else {
        m.chassis.drive(-0.7,
                        std::abs(away_) < kStraight ? 0.0
                        : away_ > 0.0               ? 1.2
                                                    : -1.2,
                        m.robot);
      }
      return true;
    }
    const bool hasMoved = lengthOf(m.view.place() - anchor_) > kMoved;
    if (!wantsToMove || hasMoved || m.view.now < since_) {
      anchor_ = m.view.place();
      since_ = m.view.now;
      return false;
    }
    if (m.view.now - since_ < kPatience) return false;
    until_ = m.view.now + kFreeing;
    since_ = until_;
    const double aside = random.uniform(0.5, 1.0) * std::numbers::pi;
    away_ = wrapAngle((m.chassis.isOmni() ? m.view.pose.theta : 0.0) +
                      (random.uniform() < 0.5 ? -aside : aside));
    return true;
  }

 private:
  static constexpr double kMoved = 0.15;             ///< distance that counts as motion [m]
  static constexpr Timestamp kPatience = 1'600'000;  ///< time without motion until it acts [us]
  static constexpr Timestamp kFreeing = 700'000;     ///< duration of the manoeuvre [us]
  /// Up to this direction it goes straight back: between posts it can't turn [rad].
  static constexpr double kStraight = 0.7 * std::numbers::pi;
  FloorPoint anchor_;
  Timestamp since_ = 0;
  Timestamp until_ = 0;
  double away_ = 0.0;  ///< direction of the manoeuvre [rad]
};

}  // namespace ortung::football_v1

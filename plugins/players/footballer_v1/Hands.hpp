#pragma once

// FROZEN, a part of the team footballer-v1: docs/matches.md tells why. Never changed; improvements
// are made in the players of today.

#include <algorithm>
#include <string_view>

#include "ortung/sim_api/Player.hpp"

namespace ortung::football_v1 {

/// The kicker and flaps of a robot, as far as it has them: a manipulator `kicker` with the state
/// `kick`, perhaps `pass`, and one `flaps` with `open` and `closed`.
class Hands {
 public:
  explicit Hands(const RobotAbilities& abilities)
      : kicks_(has(abilities, "kicker", "kick")),
        passes_(has(abilities, "kicker", "pass")),
        holds_(has(abilities, "flaps", "closed") && has(abilities, "flaps", "open")) {}

  bool canKick() const { return kicks_; }
  bool canHold() const { return holds_; }

  /// Closes the flaps around the ball, or opens them.
  void hold(bool closed, RobotCommands& robot) {
    if (!holds_ || closed == closed_) return;
    robot.setManipulator("flaps", closed ? "closed" : "open");
    closed_ = closed;
  }
  /// Kicks if the flaps are open; otherwise opens them. @returns whether it kicked
  bool kick(bool softly, RobotCommands& robot) {
    if (!kicks_) return false;
    if (closed_) {
      hold(false, robot);
      return false;
    }
    robot.setManipulator("kicker", softly && passes_ ? "pass" : "kick");
    return true;
  }

 private:
  static bool has(const RobotAbilities& abilities, std::string_view name, std::string_view state) {
    return std::any_of(
        abilities.manipulators.begin(), abilities.manipulators.end(), [&](const auto& one) {
          return one.name == name &&
                 std::find(one.states.begin(), one.states.end(), state) != one.states.end();
        });
  }
  bool kicks_;
  bool passes_;
  bool holds_;
  bool closed_ = false;
};

}  // namespace ortung::football_v1

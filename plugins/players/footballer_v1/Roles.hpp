#pragma once

// FROZEN, a part of the team footballer-v1: docs/matches.md tells why. Never changed; improvements
// are made in the players of today.

#include <algorithm>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "Plane.hpp"

namespace ortung::football_v1 {

enum class Role : std::uint8_t {
  kAttack,   ///< goes for the ball
  kCover,    ///< stays between the ball and the own goal
  kSupport,  ///< offers itself for a pass, on one side
  kWing      ///< offers itself for a pass, on the other side
};

/// A robot that takes part in the game.
struct Candidate {
  std::string name;
  double cost = 0.0;  ///< time until it has the ball [s], with a bonus for the current attacker
  FloorPoint at;
};

/// Assigns the roles: all robots with the same information get the same result. The one that
/// reaches the ball first attacks; of the others the one nearest to @p coverPlace covers; the rest
/// support, the foremost as `support`, the next as `wing`.
/// @param forward direction of the other goal along x, 1 or -1
inline Role shareRoles(std::vector<Candidate> all, const std::string& own,
                       const FloorPoint& coverPlace, double forward) {
  const auto take = [&](auto&& key) {
    const auto best = std::min_element(all.begin(), all.end(), [&](const auto& a, const auto& b) {
      return std::pair(key(a), a.name) < std::pair(key(b), b.name);
    });
    std::string name = best->name;
    all.erase(best);
    return name;
  };
  if (take([](const Candidate& one) { return one.cost; }) == own || all.empty())
    return Role::kAttack;
  if (take([&](const Candidate& one) { return lengthOf(one.at - coverPlace); }) == own)
    return Role::kCover;
  if (take([&](const Candidate& one) { return -forward * one.at.x; }) == own) return Role::kSupport;
  return Role::kWing;
}

}  // namespace ortung::football_v1

#pragma once

// FROZEN, a part of the team footballer-v1: docs/matches.md tells why. Never changed; improvements
// are made in the players of today.

#include <algorithm>
#include <cmath>

#include "Moment.hpp"
#include "Roles.hpp"

namespace ortung::football_v1 {

/// Returns the place between the ball and the own goal, before its area.
inline FloorPoint coverPlace(const Ground& ground, double forward, const FloorPoint& ball) {
  const FloorPoint goal = ground.goal(-forward);
  const double way = lengthOf(ball - goal);
  const double before = std::clamp(0.45 * way, 0.27 * ground.halfLength, 0.7 * ground.halfLength);
  const FloorPoint place = goal + before * unit(ball - goal);
  // It is not on the goal line, even if the ball is there.
  const double along = std::max(forward * place.x, -0.8 * ground.halfLength);
  return {forward * along, place.y};
}

/// Returns a place for a pass: ahead of the ball on the other side of the field, or behind it on
/// its side.
inline FloorPoint supportPlace(const Ground& ground, double forward, const FloorPoint& ball,
                               Role role) {
  const bool isAhead = role == Role::kSupport;
  const double side = (ball.y < 0.0 ? -1.0 : 1.0) * (isAhead ? -1.0 : 1.0);
  double along = forward * ball.x + (isAhead ? 0.35 : -0.22) * ground.halfLength;
  // It is outside of both penalty areas.
  along = std::clamp(along, -0.55 * ground.halfLength, 0.68 * ground.halfLength);
  // The farther aside the ball is, the farther aside, so that they move with it.
  const double aside = (isAhead ? 0.25 : 0.4) * ground.halfWidth + 0.3 * std::abs(ball.y);
  return {forward * along, side * aside};
}

/// Returns the place of a role, clear of the ball.
inline FloorPoint placeOf(Role role, const Ground& ground, double forward, const FloorPoint& ball) {
  const FloorPoint place = role == Role::kCover ? coverPlace(ground, forward, ball)
                                                : supportPlace(ground, forward, ball, role);
  constexpr double kClear = 1.2;  // [m]
  const FloorPoint off = place - ball;
  if (lengthOf(off) >= kClear) return ground.within(place, 0.4);
  return ground.within(ball + kClear * unit(off), 0.4);
}

}  // namespace ortung::football_v1

#pragma once

#include <algorithm>
#include <cmath>
#include <optional>

#include "Moment.hpp"

namespace ortung::football {

constexpr double kBallRadius = 0.11;  ///< radius of the ball [m]

/// The intention of a player with the ball.
struct Aim {
  enum class Kind { kShot, kPass, kClearance, kCarry };
  Kind kind = Kind::kCarry;
  FloorPoint target;
};

/// Returns the place in the other goal's mouth at which a ball from @p from passes all robots at
/// the greatest distance; nothing if there is none.
inline std::optional<FloorPoint> openCorner(const Moment& m, const FloorPoint& from) {
  constexpr int kPlaces = 9;
  constexpr double kGap = 0.12;  // gap between ball and body [m]
  const double reach = std::max(m.ground.halfMouth - 0.3, 0.1);
  // A ball on the line, too, goes into the goal and not along the line.
  constexpr double kDeep = 0.4;  // [m]
  const bool isOnLine =
      m.forward * (m.otherGoal().x - from.x) < kDeep && std::abs(from.y) < m.ground.halfMouth;
  const double line = m.otherGoal().x + (isOnLine ? m.forward * kDeep : 0.0);
  std::optional<FloorPoint> best;
  double most = 0.0;
  for (int i = 0; i < kPlaces; ++i) {
    const FloorPoint to{line, reach * (2.0 * i / (kPlaces - 1) - 1.0)};
    double room = 0.6;
    for (const Other& other : m.view.others)
      if (dot(other.at - from, to - from) > 0.0)
        room = std::min(room, distanceToWay(other.at, from, to) - other.radius - kBallRadius);
    if (room > kGap && room - 0.1 * std::abs(to.y) > most) {
      most = room - 0.1 * std::abs(to.y);  // without robots the middle is safest
      best = to;
    }
  }
  return best;
}

/// Returns whether a ball from @p from in the direction of @p to could end in the own goal, or
/// close to it.
inline bool isAtOwnGoal(const Moment& m, const FloorPoint& from, const FloorPoint& to) {
  constexpr double kBeside = 1.0;  // how far beside the goal is close [m]
  constexpr double kFar = 9.0;     // it does not roll farther [m]
  const FloorPoint way = unit(to - from);
  if (way.x * m.forward > -0.1) return false;
  const double away = (m.ownGoal().x - from.x) / way.x;
  return away < kFar && std::abs(from.y + away * way.y) < m.ground.halfMouth + kBeside;
}

/// Returns the place of the mate to whom a pass from @p from is best: unmarked, with a free lane,
/// and forward.
inline std::optional<FloorPoint> bestMate(const Moment& m, const FloorPoint& from,
                                          double backward) {
  constexpr double kNear = 1.5, kFar = 7.0;  // [m]
  constexpr double kAlone = 0.9;             // distance from opponents [m]
  constexpr double kAhead = 0.4;             // how far ahead of the mate the pass goes [m]
  std::optional<FloorPoint> best;
  double most = -1e3;
  for (const Other& mate : m.view.others) {
    if (!mate.isMate || mate.isKeeper) continue;
    const FloorPoint to = m.ground.within(mate.at + FloorPoint{m.forward * kAhead, 0.0}, 0.3);
    const double way = lengthOf(to - from);
    const double progress = m.forward * (to.x - from.x);
    const double alone = m.view.opponentTo(to);
    if (way < kNear || way > kFar || progress < -backward || alone < kAlone) continue;
    if (isAtOwnGoal(m, from, to)) continue;
    View others = m.view;
    std::erase_if(others.others,
                  [&](const Other& one) { return one.isMate && lengthOf(one.at - mate.at) < 0.1; });
    if (!isLaneFree(others, from, to, kBallRadius + 0.15)) continue;
    constexpr double kScores = 1.5;  // value of a mate that can shoot [m]
    const double worth =
        progress + 0.5 * std::min(alone, 3.0) + (openCorner(m, to) ? kScores : 0.0);
    if (worth > most) most = worth, best = to;
  }
  return best;
}

/// Returns the place at a distance from the ball, on the side opposite to its target.
inline FloorPoint placeBehind(const FloorPoint& ball, const FloorPoint& target, double distance) {
  return ball - distance * unit(target - ball);
}

/// Returns whether there is room on the side of the ball opposite to a target.
inline bool hasRoomBehind(const Moment& m, const FloorPoint& target, double distance) {
  if (m.hands.canHold()) return true;  // it can take the ball from any side
  const FloorPoint place = placeBehind(m.view.ball->at, target, distance);
  const auto isFree = [&](const FloorPoint& at, double radius) {
    return lengthOf(at - place) > m.view.radius + radius;
  };
  return std::all_of(m.view.others.begin(), m.view.others.end(),
                     [&](const Other& one) { return isFree(one.at, one.radius); }) &&
         std::all_of(m.ground.posts.begin(), m.ground.posts.end(),
                     [&](const Disc& one) { return isFree(one.at, one.radius); });
}

/// Returns the target of a clearance: up the field on the ball's side, otherwise straight ahead,
/// otherwise out to that side; the first one for which there is room behind the ball.
inline FloorPoint clearance(const Moment& m, double distance) {
  const FloorPoint ball = m.view.ball->at;
  const double side = ball.y < 0.0 ? -1.0 : 1.0;
  const double ahead = m.forward * m.ground.halfLength;
  const FloorPoint places[] = {
      m.ground.within({ball.x + 0.6 * ahead, 0.6 * side * m.ground.halfWidth}, 0.8),
      m.ground.within({ball.x + 0.6 * ahead, ball.y}, 0.8),
      {ball.x + 0.3 * ahead, side * m.ground.halfWidth},
      {ball.x + 0.6 * ahead, -side * 0.3 * m.ground.halfWidth}};
  for (const FloorPoint& place : places)
    if (hasRoomBehind(m, place, distance)) return place;
  return places[0];
}

}  // namespace ortung::football

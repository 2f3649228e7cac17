#pragma once

// FROZEN, a part of the team footballer-v1: docs/matches.md tells why. Never changed; improvements
// are made in the players of today.

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "Plane.hpp"
#include "RollingBall.hpp"
#include "ortung/base/Pose2.hpp"
#include "ortung/base/Time.hpp"

namespace ortung::football_v1 {

/// Another robot on the field.
struct Other {
  FloorPoint at;
  FloorPoint velocity;   ///< velocity [m/s]; 0 if unknown
  double radius = 0.36;  ///< radius of its body [m]
  bool isMate = false;
  bool isKeeper = false;  ///< whether it is a keeper, which sends no messages
};

/// A player's current knowledge, in the field frame.
struct View {
  Timestamp now = 0;
  Pose2 pose;                       ///< its own pose
  double radius = 0.36;             ///< its own radius [m]
  std::optional<RollingBall> ball;  ///< the ball; nothing: it was not seen recently
  std::vector<Other> others;

  FloorPoint place() const { return placeOf(pose); }
  /// Returns the ball's place in the robot frame. @pre ball
  FloorPoint ballInRobot() const {
    const Pose2 at = inverse(pose) * Pose2{ball->at.x, ball->at.y, 0.0};
    return {at.x, at.y};
  }
  /// Returns the distance of the nearest opponent from a place [m]; a large one if there is none.
  double opponentTo(const FloorPoint& place) const {
    double nearest = 1e3;
    for (const Other& other : others)
      if (!other.isMate) nearest = std::min(nearest, lengthOf(other.at - place));
    return nearest;
  }
};

/// Returns whether a ball on a straight path meets no robot. @param gap least distance between its
/// middle and their bodies [m]
inline bool isLaneFree(const View& view, const FloorPoint& from, const FloorPoint& to, double gap) {
  return std::none_of(view.others.begin(), view.others.end(), [&](const Other& other) {
    return dot(other.at - from, to - from) > 0.0 &&
           distanceToWay(other.at, from, to) < other.radius + gap;
  });
}

}  // namespace ortung::football_v1

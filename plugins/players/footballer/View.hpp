#pragma once

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "Plane.hpp"
#include "RollingBall.hpp"
#include "ortung/base/Pose2.hpp"
#include "ortung/base/Time.hpp"

namespace ortung::football {

/// Another robot on the field.
struct Other {
  FloorPoint at;
  FloorPoint velocity;   ///< [m/s]; 0 if it is not known
  double radius = 0.36;  ///< [m]
  bool isMate = false;
  bool isKeeper = false;  ///< it says nothing of itself
};

/// What a player knows of the moment, in the field frame.
struct View {
  Timestamp now = 0;
  Pose2 pose;                       ///< its own
  double radius = 0.36;             ///< its own [m]
  std::optional<RollingBall> ball;  ///< nothing: nobody has seen it lately
  std::vector<Other> others;

  FloorPoint place() const { return placeOf(pose); }
  /// The ball in its own frame. @pre ball
  FloorPoint ballInRobot() const {
    const Pose2 at = inverse(pose) * Pose2{ball->at.x, ball->at.y, 0.0};
    return {at.x, at.y};
  }
  /// How near the nearest opponent is to a place; far if there is none.
  double opponentTo(const FloorPoint& place) const {
    double nearest = 1e3;
    for (const Other& other : others)
      if (!other.isMate) nearest = std::min(nearest, lengthOf(other.at - place));
    return nearest;
  }
};

/// Whether a ball that is kicked along a straight way meets nobody.
/// @param gap between its middle and their bodies [m]
inline bool isLaneFree(const View& view, const FloorPoint& from, const FloorPoint& to, double gap) {
  return std::none_of(view.others.begin(), view.others.end(), [&](const Other& other) {
    return dot(other.at - from, to - from) > 0.0 &&
           distanceToWay(other.at, from, to) < other.radius + gap;
  });
}

}  // namespace ortung::football

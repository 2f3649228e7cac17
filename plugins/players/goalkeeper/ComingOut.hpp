#pragma once

#include <algorithm>
#include <cmath>
#include <optional>

#include "Chassis.hpp"
#include "GoalSide.hpp"
#include "RollingBall.hpp"
#include "ortung/base/Time.hpp"

namespace ortung {

/// Leaves the line for a ball that lies near the goal or behind the keeper, gets between it and the
/// goal, and pushes it out; and for one that rolls into the goal past the end of the line.
class ComingOut {
 public:
  /// @param within distance from the goal's middle within which it goes for the ball [m]; 0: never
  /// @param halfMouth half the width of the goal [m] @param radius the robot's radius [m]
  ComingOut(double within, const GoalSide& goal, double halfMouth, double radius)
      : within_(within), goal_(goal), halfMouth_(halfMouth), radius_(radius) {}

  /// Goes for the ball if it is its own. @returns whether it did
  bool act(Timestamp now, const Pose2& pose, const std::optional<RollingBall>& ball,
           const Chassis& chassis, RobotCommands& robot) {
    if (ball && save(pose, *ball, chassis, robot)) return true;
    if (!ball || !isItsOwn(*ball)) {
      since_.reset();
      return false;
    }
    if (!since_) since_ = now;
    const bool isBehind = goal_.depthOf(ball->at.x) < goal_.depthOf(pose.x) - kBehind;
    if (now - *since_ < (isBehind ? kPatienceBehind : kPatience)) return false;
    constexpr double kAhead = 0.25;  // it goes where the ball will be then [s]
    push(pose, ball->later(kAhead), chassis, robot);
    return true;
  }

 private:
  static constexpr double kBallRadius = 0.11;  ///< radius of the ball [m]
  static constexpr double kLies = 0.6;         ///< a ball that rolls faster may come or go [m/s]
  static constexpr double kRolls = 0.3;        ///< slower balls count as lying [m/s]
  static constexpr double kLine = 0.5;         ///< distance of its line from the goal line [m]
  static constexpr double kOnLine = 0.2;       ///< distance of its place when it saves [m]
  static constexpr double kBehind = 0.1;       ///< how far behind it a ball is behind [m]
  static constexpr double kDeep = 0.6;  ///< depth behind the goal line from which it pushes [m]
  /// How long a ball must lie before it goes for it: there, and behind it [us].
  static constexpr Timestamp kPatience = 400'000;
  static constexpr Timestamp kPatienceBehind = 120'000;
  static constexpr double kCone = 0.5;  ///< it pushes if it is so well behind the ball [rad]

  /// Returns whether a ball is slow, near, and not beside the goal where only others can go.
  bool isItsOwn(const RollingBall& ball) const {
    const FloorPoint off = ball.at - goal_.middle;
    const double depth = goal_.depthOf(ball.at.x);
    const bool isBeside = depth < radius_ && std::abs(off.y) > halfMouth_ + 0.2;
    return ball.speed() < kLies && lengthOf(off) < within_ && depth > -kBallRadius && !isBeside;
  }
  /// Stops a ball that comes from beside the goal, behind the keeper. @returns whether there is one
  bool save(const Pose2& pose, const RollingBall& ball, const Chassis& chassis,
            RobotCommands& robot) const {
    const double depth = goal_.depthOf(ball.at.x);
    const bool comesBehind = depth < goal_.depthOf(pose.x) &&
                             std::abs(ball.at.y - goal_.middle.y) < within_ + halfMouth_;
    // Where it passes the place at which the keeper saves, otherwise where it would be in.
    auto crossing = ball.crossing(goal_.before(kOnLine, 0.0).x);
    if (!crossing || std::abs(crossing->y - goal_.middle.y) > halfMouth_ + kBallRadius)
      crossing = ball.crossing(goal_.middle.x - goal_.inwards * kBallRadius);
    if (!comesBehind && !passesBeside(ball)) return false;
    if (ball.speed() < kRolls || !crossing) return false;
    const double aside = crossing->y - goal_.middle.y;
    if (std::abs(aside) > halfMouth_ + kBallRadius ||
        lengthOf(ball.at - goal_.middle) > within_ + 1.0)
      return false;
    const FloorPoint way =
        goal_.before(kOnLine, std::clamp(aside, -halfMouth_ + 0.2, halfMouth_ - 0.2)) -
        placeOf(pose);
    chassis.move(pose, chassis.speedFor(lengthOf(way)) * unit(way), pose.theta, robot);
    return true;
  }
  /// Returns whether a ball reaches the goal without crossing the keeper's line before the goal.
  bool passesBeside(const RollingBall& ball) const {
    const auto crossing = ball.crossing(goal_.before(kLine, 0.0).x);
    return crossing && std::abs(crossing->y - goal_.middle.y) > halfMouth_;
  }
  /// Returns the nearest place that is neither in a post nor too deep in the goal.
  FloorPoint possible(FloorPoint at) const {
    const double depth = std::max(goal_.depthOf(at.x), -kDeep + radius_);
    const double aside = at.y - goal_.middle.y;
    const double room = std::max(halfMouth_ - radius_, 0.0);
    return goal_.before(depth, depth < radius_ ? std::clamp(aside, -room, room) : aside);
  }

  void push(const Pose2& pose, const FloorPoint& ball, const Chassis& chassis,
            RobotCommands& robot) const {
    const FloorPoint from = placeOf(pose);
    const FloorPoint out = unit(ball - goal_.before(-kDeep, 0.0));
    const double clear = radius_ + kBallRadius + 0.02;
    const FloorPoint behind = possible(ball - clear * out);
    const double now = angleOf(from - ball);
    const double off = wrapAngle(angleOf(behind - ball) - now);
    const double away = lengthOf(from - ball);
    const double heading = pose.theta;
    if (std::abs(off) < kCone)
      return chassis.move(pose, chassis.limits().speed * unit(ball - from), heading, robot);
    // Around the ball: along a circle, and out to it or in.
    constexpr double kGap = 0.12;  // it must not touch the ball from the wrong side [m]
    const double step = std::copysign(std::min(std::abs(off), 0.5), off);
    const double radius = std::max(clear + kGap, std::min(away, 1.3 * clear));
    const FloorPoint next = possible(ball + radius * towards(now + step));
    const FloorPoint way = next - from;
    chassis.move(pose, std::max(chassis.speedFor(lengthOf(way)), 0.5) * unit(way), heading, robot);
  }

  double within_;
  GoalSide goal_;
  double halfMouth_;
  double radius_;
  std::optional<Timestamp> since_;  ///< time since which the ball is its own
};

}  // namespace ortung

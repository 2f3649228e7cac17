#pragma once

#include <cmath>
#include <optional>
#include <stdexcept>
#include <string>

#include "GoalSide.hpp"
#include "ortung/sim_api/Player.hpp"

namespace ortung {

/// The knowledge of all kinds of strikers: their goal, and the true state of the stage.
struct Attack {
  GoalSide goal;
  double halfMouth = 1.0;    ///< half the goal's width [m]
  double braking = 0.2943;   ///< deceleration of a rolling ball [m/s^2]
  double ballAhead = 0.285;  ///< distance from the robot's middle to a ball at its kicker [m]

  /// Returns the ball. @throws std::runtime_error if there is none
  static const StagedThing& ball(PlayerSeat& seat) {
    for (const StagedThing& thing : seat.stage()->things())
      if (thing.kind == "ball") return thing;
    throw std::runtime_error("there is no ball on the field");
  }
  static const StagedRobot& self(PlayerSeat& seat) {
    for (const StagedRobot& robot : seat.stage()->robots())
      if (robot.name == seat.name()) return robot;
    throw std::runtime_error("its robot is not on the stage");
  }
  /// Returns the other robot that is nearest to the goal, if it is within 2 m of it.
  std::optional<FloorPoint> keeper(PlayerSeat& seat) const {
    std::optional<FloorPoint> found;
    double nearest = 2.0;
    for (const StagedRobot& robot : seat.stage()->robots()) {
      const double away = std::hypot(robot.pose.x - goal.middle.x, robot.pose.y - goal.middle.y);
      if (robot.name == seat.name() || away >= nearest) continue;
      nearest = away;
      found = FloorPoint{robot.pose.x, robot.pose.y};
    }
    return found;
  }
  /// Returns the corner of the goal that is farther from the keeper, slightly inside the post;
  /// without a keeper the left one.
  FloorPoint freeCorner(PlayerSeat& seat) const { return freeCorner(keeper(seat)); }
  FloorPoint freeCorner(const std::optional<FloorPoint>& stands) const {
    constexpr double kWithin = 0.25;  // [m]
    const double side = stands && stands->y > goal.middle.y ? -1.0 : 1.0;
    return {goal.middle.x, goal.middle.y + side * (halfMouth - kWithin)};
  }
  /// Returns a random place between two distances before the goal line and at most so far aside
  /// from the goal's middle [m]. Its numbers are drawn one by one, since a compiler may compute
  /// arguments of a call in any order.
  FloorPoint somewhere(Random& random, double nearest, double farthest, double aside) const {
    const double y = random.uniform(-aside, aside);
    return goal.before(random.uniform(nearest, farthest), y);
  }
  /// Places the robot, and the ball at its kicker. @returns whether there is room
  bool putWithBall(PlayerSeat& seat, const Pose2& pose) const {
    return put(seat, pose, pose * Pose2{ballAhead, 0.0, 0.0}, {});
  }
  static bool put(PlayerSeat& seat, const Pose2& robot, const Pose2& ball, const Twist& velocity) {
    const std::string name = Attack::ball(seat).name;
    try {
      seat.stage()->placeRobot(seat.name(), robot);
      seat.stage()->placeThing(name, {ball.x, ball.y, 0.0}, velocity);
    } catch (const std::invalid_argument&) {
      return false;  // there is no room
    }
    return true;
  }
};

/// A kind of striker, which makes a situation and acts in it.
class Strike {
 public:
  virtual ~Strike() = default;
  /// Makes a random situation. @returns false if there is no room for it; another one may be drawn
  virtual bool setUp(PlayerSeat& seat) = 0;
  virtual void act(PlayerSeat& seat) = 0;
  virtual std::optional<BelievedPose> believedPose() const { return std::nullopt; }
};

inline double angleTo(const FloorPoint& from, const FloorPoint& to) {
  return std::atan2(to.y - from.y, to.x - from.x);
}

}  // namespace ortung

#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "Attack.hpp"
#include "AttackView.hpp"
#include "Steering.hpp"

namespace ortung {

/// Drives with the ball between its horns towards the goal, and kicks as soon as the path ahead of
/// it is not covered by the keeper, or when it is near.
class Dribble : public Strike {
 public:
  Dribble(const Attack& attack, SightMode sees) : attack_(attack), view_(attack, sees) {}

  bool setUp(PlayerSeat& seat) override {
    Random& random = seat.random();
    const FloorPoint at = attack_.somewhere(random, 3.5, 5.0, 1.5);
    shootsFrom_ = random.uniform(1.8, 2.8);
    kicked_ = false;
    const double off = random.uniform(-0.2, 0.2);
    const Pose2 pose{at.x, at.y, wrapAngle(angleTo(at, attack_.goal.middle) + off)};
    if (!attack_.putWithBall(seat, pose)) return false;
    view_.begin(seat, pose);
    return true;
  }

  void act(PlayerSeat& seat) final {
    const bool knows = view_.update(seat);
    if (knows && kicked_ && failed(seat)) kicked_ = false;
    if (kicked_ || !knows) return Steering::stand(seat.robot());
    play(seat);
  }
  std::optional<BelievedPose> believedPose() const override { return view_.own().believed(); }

 protected:
  /// Acts as long as it knows its pose and has not kicked.
  virtual void play(PlayerSeat& seat) {
    if (!carry(seat)) return;
    const Pose2& pose = view_.pose();
    const double depth = attack_.goal.depthOf(pose.x);
    const bool wants = depth < kNearest || (depth < shootsFrom_ && isOpen(pose));
    if (wants && view_.isAtKicker()) return kick(seat);
    BallCarrier::drive(pose, view_.freeCorner(), seat.robot());
  }
  /// Returns whether it has the ball; otherwise it fetches it.
  bool carry(PlayerSeat& seat) {
    if (view_.hasBall()) return hasCarried_ = true;
    BallCarrier::fetch(view_.ballInRobot(),
                       hasCarried_ ? BallCarrier::kSpeed : BallCarrier::kGently, seat.robot());
    return false;
  }
  void kick(PlayerSeat& seat) {
    seat.robot().setManipulator("kicker", "kick");
    kicked_ = true;
    kickedAt_ = seat.now();
  }
  /// Returns whether it has kicked but the ball is still there.
  bool failed(PlayerSeat& seat) const {
    constexpr Timestamp kPatience = 400'000;  // [us]
    const Pose2 ball = view_.ballInRobot();
    return seat.now() > kickedAt_ + kPatience && std::hypot(ball.x, ball.y) < 0.8;
  }

  Attack attack_;
  AttackView view_;
  double shootsFrom_ = 2.0;  ///< distance from the goal within which it kicks [m]
  bool kicked_ = false;
  bool hasCarried_ = false;
  Timestamp kickedAt_ = 0;
  /// Distance from the goal within which it kicks in any case [m].
  static constexpr double kNearest = 1.3;
  /// Least distance of the keeper's middle from the ball's path [m].
  static constexpr double kGap = 0.4;

  /// Returns whether the path ahead leads into the goal and past the keeper.
  bool isOpen(const Pose2& pose) const {
    const double ahead = std::cos(pose.theta) * -attack_.goal.inwards;
    if (ahead <= 0.2) return false;
    const auto placeAt = [&](double x) { return pose.y + (x - pose.x) * std::tan(pose.theta); };
    constexpr double kWithin = 0.12;  // half a ball [m]
    if (std::abs(placeAt(attack_.goal.middle.x) - attack_.goal.middle.y) >
        attack_.halfMouth - kWithin)
      return false;
    const auto& keeper = view_.keeper();
    return !keeper || std::abs(placeAt(keeper->x) - keeper->y) > kGap;
  }
};

/// Finds a lying ball, drives around it and to it, and dribbles.
class Seek : public Dribble {
 public:
  using Dribble::Dribble;

  bool setUp(PlayerSeat& seat) override {
    Random& random = seat.random();
    const FloorPoint at = attack_.somewhere(random, 4.5, 6.5, 2.5);
    const FloorPoint ball = attack_.somewhere(random, 2.5, 3.8, 2.0);
    shootsFrom_ = random.uniform(2.0, 4.0);
    kicked_ = hasCarried_ = isUpToIt_ = false;
    const Pose2 pose{at.x, at.y, random.uniform(-std::numbers::pi, std::numbers::pi)};
    if (!Attack::put(seat, pose, {ball.x, ball.y, 0.0}, {})) return false;
    view_.begin(seat, pose);
    return true;
  }

 private:
  void play(PlayerSeat& seat) override {
    isUpToIt_ = isUpToIt_ ? isBefore() : isBehind();
    if (isUpToIt_) return Dribble::play(seat);
    Steering({.speed = kSpeed, .turn = 3.0, .acceleration = 2.0, .turnAcceleration = 8.0})
        .steer(view_.pose(), wayPoint(), seat.robot());
  }

  static constexpr double kSpeed = 1.6;  ///< speed without the ball [m/s]
  /// Distance behind the ball from which it approaches it [m].
  static constexpr double kBehind = 0.7;
  bool isUpToIt_ = false;  ///< whether it is approaching the ball

  /// Returns whether the ball is still ahead, though maybe not in the direction of the goal.
  bool isBefore() const {
    const Pose2 ball = view_.ballInRobot();
    return ball.x > 0.0 && std::abs(std::atan2(ball.y, ball.x)) < 1.0 && ball.x < 2.0;
  }
  /// Returns the unit vector to the ball from the corner of the goal that is its target.
  FloorPoint away() const {
    const FloorPoint goal = view_.freeCorner();
    const double dx = view_.ball().x - goal.x;
    const double dy = view_.ball().y - goal.y;
    const double d = std::max(std::hypot(dx, dy), 1e-3);
    return {dx / d, dy / d};
  }
  /// Returns whether that corner is behind the ball as seen from the robot.
  bool isBehind() const {
    constexpr double kWithin = 0.2;  // [rad]
    const Pose2& pose = view_.pose();
    const FloorPoint& ball = view_.ball();
    const double toBall = angleTo({pose.x, pose.y}, ball);
    const double toGoal = angleTo(ball, view_.freeCorner());
    return std::abs(wrapAngle(toBall - toGoal)) < kWithin &&
           std::hypot(ball.x - pose.x, ball.y - pose.y) < 2.0 * kBehind;
  }
  /// Returns the place behind the ball, or one beside the ball first if it would be in the way.
  FloorPoint wayPoint() const {
    const FloorPoint back = away();
    const FloorPoint& ball = view_.ball();
    const Pose2& pose = view_.pose();
    const double along = (pose.x - ball.x) * back.x + (pose.y - ball.y) * back.y;
    const double aside = (pose.y - ball.y) * back.x - (pose.x - ball.x) * back.y;
    if (along > 0.3) return {ball.x + kBehind * back.x, ball.y + kBehind * back.y};
    const double side = aside < 0.0 ? -kBehind : kBehind;
    return {ball.x + 0.5 * back.x - side * back.y, ball.y + 0.5 * back.y + side * back.x};
  }
};

/// Carries the ball to one side so that the keeper follows, turns as sharply as it can with the
/// ball between its horns, and kicks into the other corner.
class Feint : public Dribble {
 public:
  using Dribble::Dribble;

  bool setUp(PlayerSeat& seat) override {
    Random& random = seat.random();
    const FloorPoint at = attack_.somewhere(random, 4.6, 5.2, 0.5);
    side_ = random.uniform() < 0.5 ? -1.0 : 1.0;
    out_ = random.uniform(0.7, 1.2);
    depth_ = random.uniform(3.2, 3.6);
    isThere_ = kicked_ = hasCarried_ = false;
    const Pose2 pose{at.x, at.y, angleTo(at, attack_.goal.middle)};
    if (!attack_.putWithBall(seat, pose)) return false;
    view_.begin(seat, pose);
    return true;
  }

 private:
  void play(PlayerSeat& seat) override {
    if (!carry(seat)) return;
    const Pose2& pose = view_.pose();
    const FloorPoint lure = attack_.goal.before(depth_, side_ * out_);
    isThere_ = isThere_ || attack_.goal.depthOf(view_.ball().x) < depth_ + 0.1;
    if (!isThere_) return BallCarrier::drive(pose, lure, seat.robot());
    constexpr double kWithin = 0.4;  // distance of its target from the post [m]
    const FloorPoint corner = attack_.goal.before(0.0, -side_ * (attack_.halfMouth - kWithin));
    constexpr double kAimed = 0.08;  // [rad]
    constexpr double kLast = 0.9;    // distance from the goal within which it kicks in any case [m]
    const double error = wrapAngle(angleTo({pose.x, pose.y}, corner) - pose.theta);
    const double depth = attack_.goal.depthOf(pose.x);
    const bool wants =
        std::abs(error) < kAimed || (depth < kNearest && isOpen(pose)) || depth < kLast;
    if (wants && view_.isAtKicker()) return kick(seat);
    BallCarrier::drive(pose, corner, seat.robot());
  }

  double side_ = 1.0;   ///< side to which it lures the keeper, 1: left of the field
  double out_ = 1.0;    ///< how far aside it carries the ball [m]
  double depth_ = 2.0;  ///< distance from the goal line to which it carries the ball [m]
  bool isThere_ = false;
};

}  // namespace ortung

#pragma once

#include <cmath>
#include <optional>

#include "Attack.hpp"
#include "OwnSight.hpp"

namespace ortung {

/// A striker's view of itself, the ball and the keeper while it plays: the truth, or what its own
/// sensors show.
class AttackView {
 public:
  AttackView(const Attack& attack, SightMode mode) : attack_(attack), own_(mode) {}

  /// Begins at a pose that it knows approximately.
  void begin(PlayerSeat& seat, const Pose2& placed) {
    ball_.reset();
    keeper_.reset();
    newest_ = seat.now();
    if (own_.isTruth()) return;
    const Pose2 told{placed.x + kPlacedWithin * seat.random().gaussian(),
                     placed.y + kPlacedWithin * seat.random().gaussian(),
                     wrapAngle(placed.theta + kPlacedTurned * seat.random().gaussian())};
    own_.begin(seat, told, kPlacedWithin, kPlacedTurned);
  }
  /// Updates the view; to be called whenever it acts. @returns whether it knows its pose and has
  /// seen the ball
  bool update(PlayerSeat& seat) {
    own_.update(seat);
    if (!own_.pose()) return false;
    if (own_.isTruth()) {
      const Pose2 ball = Attack::ball(seat).pose;
      ball_ = FloorPoint{ball.x, ball.y};
      keeper_ = attack_.keeper(seat);
    } else {
      look(seat, *own_.pose());
    }
    return ball_.has_value();
  }

  // --- in the field frame, after update() has returned true
  const Pose2& pose() const { return *own_.pose(); }
  const FloorPoint& ball() const { return *ball_; }
  /// Returns the keeper; nothing if it sees none before the goal.
  const std::optional<FloorPoint>& keeper() const { return keeper_; }
  /// Returns the ball's place in the robot frame [m].
  Pose2 ballInRobot() const { return inverse(pose()) * Pose2{ball_->x, ball_->y, 0.0}; }
  FloorPoint freeCorner() const { return attack_.freeCorner(keeper_); }
  /// Returns whether the ball is between the horns.
  bool hasBall() const {
    constexpr double kLost = 0.15;  // distance from its place beyond which the ball is lost [m]
    const Pose2 ball = ballInRobot();
    return std::hypot(ball.x - attack_.ballAhead, ball.y) < kLost;
  }
  /// Returns whether a kick would hit the ball.
  bool isAtKicker() const {
    const Pose2 ball = ballInRobot();
    return ball.x > 0.0 && ball.x < attack_.ballAhead + 0.05 && std::abs(ball.y) < 0.12;
  }
  const OwnSight& own() const { return own_; }

 private:
  /// Standard deviation of the start position that it gets [m].
  static constexpr double kPlacedWithin = 0.2;
  /// Standard deviation of the start heading that it gets [rad].
  static constexpr double kPlacedTurned = 0.1;

  /// Takes the sightings of a new image, transformed into the field frame.
  void look(PlayerSeat& seat, const Pose2& pose) {
    constexpr double kShare = 0.7;   // weight of a new sighting
    constexpr double kFar = 3.0;     // standard deviations beyond which the ball has moved
    constexpr double kBefore = 2.0;  // a robot this near to the goal is the keeper [m]
    const auto seen = own_.ball(seat);
    if (seen && seen->stamp > newest_) {
      const Pose2 at = pose * seen->inRobot;
      const bool isSame =
          ball_ && std::hypot(at.x - ball_->x, at.y - ball_->y) < kFar * seen->sigma;
      const double share = isSame ? kShare : 1.0;
      const FloorPoint old = ball_.value_or(FloorPoint{});
      ball_ =
          FloorPoint{share * at.x + (1.0 - share) * old.x, share * at.y + (1.0 - share) * old.y};
      newest_ = seen->stamp;
    }
    double nearest = kBefore;
    for (const Sighting& robot : own_.robots(seat)) {
      if (robot.stamp < newest_) continue;
      const Pose2 at = pose * robot.inRobot;
      const double away = std::hypot(at.x - attack_.goal.middle.x, at.y - attack_.goal.middle.y);
      if (away >= nearest) continue;
      nearest = away;
      keeper_ = FloorPoint{at.x, at.y};
    }
  }

  Attack attack_;
  OwnSight own_;
  Timestamp newest_ = 0;  ///< stamp of the newest image with a ball
  std::optional<FloorPoint> ball_;
  std::optional<FloorPoint> keeper_;
};

/// Carries the ball between the horns: it drives forward and turns slowly so that the ball stays
/// there.
class BallCarrier {
 public:
  static constexpr double kSpeed = 0.8;   ///< speed with the ball [m/s]
  static constexpr double kTurn = 0.6;    ///< turn rate with the ball [rad/s]
  static constexpr double kGently = 0.4;  ///< speed of the approach to a lying ball [m/s]

  static void drive(const Pose2& pose, const FloorPoint& to, RobotCommands& robot) {
    const double error = wrapAngle(angleTo({pose.x, pose.y}, to) - pose.theta);
    robot.setRotationalVelocity(std::clamp(2.0 * error, -kTurn, kTurn));
    robot.setTranslationalVelocity(kSpeed);
  }
  /// Turns to the ball and drives to it.
  /// @param speed speed at which it touches the ball [m/s]: a lying ball bounces off, one that was
  ///   carried rolls on
  static void fetch(const Pose2& ball, double speed, RobotCommands& robot) {
    const double bearing = std::atan2(ball.y, ball.x);
    const double gap = std::max(std::hypot(ball.x, ball.y) - 0.3, 0.0);
    robot.setRotationalVelocity(std::clamp(4.0 * bearing, -2.5, 2.5));
    robot.setTranslationalVelocity(std::abs(bearing) < 0.5 ? std::min(speed + 2.0 * gap, 1.6)
                                                           : 0.0);
  }
};

}  // namespace ortung

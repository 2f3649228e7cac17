#pragma once

// FROZEN: the striker by which keepers of all versions are compared. Its random draws, its
// behaviour and every number here never change, and it uses nothing that may change but the names
// of the stage; tests/benchmark/YardstickTest.cpp checks a hash of its behaviour. An improved
// striker must become yardstick-v2.

#include <algorithm>
#include <cmath>
#include <string>

#include "Attack.hpp"

namespace ortung {

/// Drives towards the goal with the ball between its horns, turns towards the corner that the
/// keeper does not cover, and kicks.
class YardstickV1 : public Strike {
 public:
  explicit YardstickV1(const GoalSide& goal) : goal_(goal) {}

  bool setUp(PlayerSeat& seat) override {
    const double depth = seat.random().uniform(3.0, 4.5);
    const double aside = seat.random().uniform(-1.5, 1.5);
    const double off = seat.random().uniform(-0.2, 0.2);
    latest_ = seat.random().uniform(0.6, 1.6);
    error_ = seat.random().uniform(-0.05, 0.05);
    const double x = goal_.middle.x + goal_.inwards * depth;
    const double y = goal_.middle.y + aside;
    const double theta = wrapAngle(std::atan2(goal_.middle.y - y, goal_.middle.x - x) + off);
    begun_ = seat.now();
    kicked_ = false;
    return Attack::put(seat, {x, y, theta},
                       {x + 0.285 * std::cos(theta), y + 0.285 * std::sin(theta), 0.0}, {});
  }

  void act(PlayerSeat& seat) override {
    if (kicked_) return stand(seat.robot());
    const Pose2 pose = Attack::self(seat).pose;
    const double passed = static_cast<double>(seat.now() - begun_) * 1e-6;
    if (passed < latest_) return drive(seat.robot(), 0.6, 0.0);
    double keeper = 0.0;  // at the middle if there is none
    double nearest = 2.0;
    for (const StagedRobot& robot : seat.stage()->robots()) {
      const double away = std::hypot(robot.pose.x - goal_.middle.x, robot.pose.y - goal_.middle.y);
      if (robot.name == seat.name() || away >= nearest) continue;
      nearest = away;
      keeper = robot.pose.y - goal_.middle.y;
    }
    const double corner = goal_.middle.y + (keeper > 0.0 ? -0.75 : 0.75);
    const double wanted = std::atan2(corner - pose.y, goal_.middle.x - pose.x) + error_;
    const double turn = wrapAngle(wanted - pose.theta);
    if (std::abs(turn) < 0.03 || passed > latest_ + 1.5) {
      seat.robot().setManipulator("kicker", "kick");
      kicked_ = true;
      return stand(seat.robot());
    }
    drive(seat.robot(), 0.6, std::clamp(3.0 * turn, -0.8, 0.8));
  }

 private:
  static void drive(RobotCommands& robot, double speed, double turn) {
    robot.setTranslationalVelocity(speed);
    robot.setRotationalVelocity(turn);
  }
  static void stand(RobotCommands& robot) { drive(robot, 0.0, 0.0); }

  GoalSide goal_;
  double latest_ = 1.0;  ///< time after which it turns and kicks [s]
  double error_ = 0.0;   ///< error of its aim [rad]
  Timestamp begun_ = 0;
  bool kicked_ = false;
};

}  // namespace ortung

#include "ortung/benchmark/GoalJudge.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "Contact.hpp"

namespace ortung {
namespace {

constexpr double kBack = 0.2;   ///< speed away from the goal from which a ball comes back [m/s]
constexpr double kRest = 0.05;  ///< speed below which a ball lies still [m/s]
/// Gap between ball and body that counts as contact, besides the distance rolled [m].
constexpr double kTouch = 0.01;
constexpr double kBump = 0.1;  ///< least change of the ball's velocity by a touch [m/s]

/// Returns whether the ball is at one of the robot's pieces, or was during the cycle.
bool isAt(const SimRobot& robot, const Simulation::Thing& ball, double cycle) {
  const double rolled = std::hypot(ball.velocity.x, ball.velocity.y) * cycle;
  const double reach = GoalField::kBall + kTouch + rolled;
  return distanceToPieces(robot, ball) < reach;
}

}  // namespace

std::string_view nameOf(GoalOutcome outcome) {
  constexpr std::array<std::string_view, 4> kNames = {"goal", "saved", "out", "time"};
  return kNames[static_cast<std::size_t>(outcome)];
}

bool GoalJudge::sees(const Simulation::Thing& ball, const SimRobot& keeper, double cycle) {
  const double towards = -ball.velocity.x;
  wasShot_ = wasShot_ || towards > kShot;
  const double bump = std::hypot(ball.velocity.x - velocity_.x, ball.velocity.y - velocity_.y);
  velocity_ = ball.velocity;
  wasTouched_ = wasTouched_ || (wasShot_ && bump > kBump && isAt(keeper, ball, cycle));
  if (ball.pose.x < GoalField::kGoalX - GoalField::kBall) {
    outcome_ = std::abs(ball.pose.y) < GoalField::kHalfMouth ? GoalOutcome::kGoal : missed();
    return true;
  }
  const bool isOff = ball.pose.x > GoalField::kHalfLength + GoalField::kBall ||
                     std::abs(ball.pose.y) > GoalField::kHalfWidth + GoalField::kBall;
  const bool isBack =
      wasShot_ && (towards < -kBack || std::hypot(ball.velocity.x, ball.velocity.y) < kRest);
  if (isOff || isBack) outcome_ = missed();
  return isOff || isBack;
}

}  // namespace ortung

// What a footballer wants to do with the ball.
#include <gtest/gtest.h>

#include "Attack.hpp"
#include "Situation.hpp"

namespace ortung::football {
namespace {

/// Opponents side by side in the other goal's mouth, who leave no corner.
const std::vector<Other> kWall = [] {
  std::vector<Other> wall;
  for (const double y : {-0.8, -0.4, 0.0, 0.4, 0.8})
    wall.push_back({{5.6, y}, {}, 0.36, false, false});
  return wall;
}();

/// What it wants that has had the ball at its kicker for some time. @param x of the ball, before
/// the middle of the goal at x = 6 [m]
Aim aimAt(double x, double seconds, const std::vector<Other>& others) {
  Situation s;
  s.view.pose = {x - 0.28, 0.0, 0.0};
  s.view.ball = RollingBall{{x, 0.0}, 0.0, 0.0, 0.3};
  s.view.others = others;
  Attack attack{Skill{}};
  Random random(1);
  attack.act(s.moment(), random);
  // A choice other than to carry the ball holds for 0.6 s.
  s.view.now = fromSeconds(seconds);
  attack.act(s.moment(), random);
  return *attack.aim();
}

using Kind = Aim::Kind;

// With a range of 4.5 m, and 5 s for which it may have the ball.
TEST(FootballAttack, ShootsWithinItsRangeAndFartherOnlyWhenItIsLate) {
  for (const double seconds : {1.0, 4.99, 5.01}) {
    EXPECT_EQ(aimAt(6.0 - 4.49, seconds, {}).kind, Kind::kShot);
    const bool isLate = seconds > 5.0;
    EXPECT_EQ(aimAt(6.0 - 4.51, seconds, {}).kind, isLate ? Kind::kShot : Kind::kCarry);
    // 1.6 * 4.5 m are 7.2 m.
    EXPECT_EQ(aimAt(6.0 - 7.19, seconds, {}).kind, isLate ? Kind::kShot : Kind::kCarry);
    EXPECT_EQ(aimAt(6.0 - 7.21, seconds, {}).kind, isLate ? Kind::kClearance : Kind::kCarry);
  }
}

TEST(FootballAttack, ShootsWithoutAnOpenCornerOnlyNearTheGoal) {
  // 0.4 * 4.5 m are 1.8 m.
  const Aim near = aimAt(6.0 - 1.79, 1.0, kWall);
  EXPECT_EQ(near.kind, Kind::kShot);
  EXPECT_EQ(near.target.x, 6.0);
  EXPECT_EQ(near.target.y, 0.0) << "the middle of the goal";
  EXPECT_EQ(aimAt(6.0 - 1.81, 1.0, kWall).kind, Kind::kCarry);
  EXPECT_EQ(aimAt(6.0 - 1.81, 5.01, kWall).kind, Kind::kShot);
}

TEST(FootballAttack, PassesWhoIsPressedLateOrShutOut) {
  const Other mate{{0.5, 2.5}, {}, 0.36, true, false};
  EXPECT_EQ(aimAt(-2.0, 1.0, {mate}).kind, Kind::kCarry);
  EXPECT_EQ(aimAt(-2.0, 5.01, {mate}).kind, Kind::kPass);
  const Other near{{-2.0, -0.89}, {}, 0.36, false, false};
  EXPECT_EQ(aimAt(-2.0, 1.0, {mate, near}).kind, Kind::kPass);
  const Other farther{{-2.0, -0.91}, {}, 0.36, false, false};
  EXPECT_EQ(aimAt(-2.0, 1.0, {mate, farther}).kind, Kind::kCarry);
  std::vector<Other> shutOut = kWall;
  shutOut.push_back({{3.0, 3.0}, {}, 0.36, true, false});
  EXPECT_EQ(aimAt(3.0, 1.0, shutOut).kind, Kind::kPass);
}

// Its own goal is at x = -6, and 0.6 * 6 m before it end at -2.4.
TEST(FootballAttack, ClearsTheBallThatIsPressedAtHome) {
  const auto pressedAt = [](double x) {
    return aimAt(x, 1.0, {{{x, -0.8}, {}, 0.36, false, false}}).kind;
  };
  EXPECT_EQ(pressedAt(-2.41), Kind::kClearance);
  EXPECT_EQ(pressedAt(-2.39), Kind::kCarry);
  EXPECT_EQ(aimAt(-5.0, 1.0, {}).kind, Kind::kCarry);
}

}  // namespace
}  // namespace ortung::football

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "Policy.hpp"

namespace ortung {
namespace {

const KeeperLine kLine{{-6.0, 0.0}, -5.5, 0.75};

RollingBall ballAt(double x, double y, double vx = 0.0, double vy = 0.0) {
  return {{x, y}, vx, vy, 0.3};
}

TEST(KeeperPolicy, StillNeverWantsAnything) {
  KeeperMind mind(KeeperPolicy::kStill, kLine);
  Random random(1);
  for (Timestamp now = 0; now < 5'000'000; now += 40'000)
    EXPECT_FALSE(mind.decide(now, 0.0, ballAt(-3.0, 1.0, -3.0, 0.0), random));
}

TEST(KeeperPolicy, BlockingStandsBetweenBallAndMiddleOfTheGoal) {
  KeeperMind mind(KeeperPolicy::kBlocking, kLine);
  Random random(1);
  for (const double y : {-2.0, -0.3, 0.0, 1.7}) {
    const auto wanted = mind.decide(0, 0.0, ballAt(-3.0, y), random);
    ASSERT_TRUE(wanted);
    // Ball, keeper and goal on one straight line: no cross product.
    EXPECT_NEAR((-3.0 + 6.0) * *wanted - y * (-5.5 + 6.0), 0.0, 1e-12) << y;
  }
  // No farther than it may.
  EXPECT_DOUBLE_EQ(*mind.decide(0, 0.0, ballAt(-5.6, 3.0), random), 0.75);
  EXPECT_DOUBLE_EQ(*mind.decide(0, 0.0, std::nullopt, random), 0.0);
}

TEST(KeeperPolicy, BlockingDoesSoBeforeTheOtherGoal) {
  const KeeperLine other{{6.0, 0.5}, 5.5, 0.75};
  EXPECT_NEAR(other.blockingPlace({2.0, 2.5}), 0.5 + 2.0 * 0.5 / 4.0, 1e-12);
}

TEST(KeeperPolicy, InterceptingGoesWhereTheBallWillCome) {
  KeeperMind mind(KeeperPolicy::kIntercepting, kLine);
  Random random(1);
  // 2.5 m ahead with a slope of 1/5: half a metre aside.
  EXPECT_NEAR(*mind.decide(0, 0.0, ballAt(-3.0, 0.0, -2.5, 0.5), random), 0.5, 1e-12);
  // One that stops before (1.1^2 / 0.6 = 2.0 m), rolls away or lies is blocked.
  for (const RollingBall& ball :
       {ballAt(-3.0, 1.2, -1.1, 0.2), ballAt(-3.0, 1.2, 2.0, 0.0), ballAt(-3.0, 1.2)})
    EXPECT_NEAR(*mind.decide(0, 0.0, ball, random), 1.2 * 0.5 / 3.0, 1e-12) << ball.speedX;
  EXPECT_DOUBLE_EQ(*mind.decide(0, 0.0, ballAt(-3.0, 0.0, -2.5, 2.5), random), 0.75);
}

TEST(KeeperPolicy, PatternGoesToAndFroBetweenItsEnds) {
  KeeperMind mind(KeeperPolicy::kPattern, kLine);
  Random random(1);
  double y = 0.1;
  double most = y;
  double least = y;
  int turns = 0;
  double side = 0.0;
  for (Timestamp now = 0; now < 10'000'000; now += 40'000) {
    const double wanted = *mind.decide(now, y, std::nullopt, random);
    EXPECT_DOUBLE_EQ(std::abs(wanted), 0.75);
    turns += side != 0.0 && side != wanted;
    side = wanted;
    y += std::clamp(wanted - y, -0.06, 0.06);  // at 1.5 m/s
    most = std::max(most, y);
    least = std::min(least, y);
  }
  EXPECT_NEAR(most, 0.75, 0.06);
  EXPECT_NEAR(least, -0.75, 0.06);
  // 15 m in ways of 1.4 to 1.5 m.
  EXPECT_NEAR(turns, 10, 1);
}

TEST(KeeperPolicy, RandomGoesEverywhereAndIsTheSameForASeed) {
  std::set<int> tenths;
  KeeperMind a(KeeperPolicy::kRandom, kLine);
  KeeperMind b(KeeperPolicy::kRandom, kLine);
  KeeperMind c(KeeperPolicy::kRandom, kLine);
  Random ofA(4);
  Random ofB(4);
  Random ofC(5);
  bool differs = false;
  for (Timestamp now = 0; now < 200'000'000; now += 40'000) {
    const double wanted = *a.decide(now, 2.0, std::nullopt, ofA);
    EXPECT_EQ(wanted, *b.decide(now, 2.0, std::nullopt, ofB));
    differs = differs || wanted != *c.decide(now, 2.0, std::nullopt, ofC);
    EXPECT_LE(std::abs(wanted), 0.75);
    tenths.insert(static_cast<int>(std::floor(wanted / 0.1)));
  }
  EXPECT_TRUE(differs);
  EXPECT_EQ(tenths.size(), 16u);  // from -0.8 to 0.8
}

TEST(KeeperPolicy, MixedIsEachOfTheOthersInTurn) {
  KeeperMind mind(KeeperPolicy::kMixed, kLine);
  Random random(2);
  int none = 0;
  int blocks = 0;
  int intercepts = 0;
  int ends = 0;
  constexpr int kDecisions = 10'000;
  for (int i = 0; i < kDecisions; ++i) {
    const auto wanted = mind.decide(i * 40'000, 0.0, ballAt(-3.0, 1.2, -3.0, -0.84), random);
    none += !wanted;
    blocks += wanted && std::abs(*wanted - 0.2) < 1e-9;
    intercepts += wanted && std::abs(*wanted - 0.5) < 1e-9;
    ends += wanted && std::abs(std::abs(*wanted) - 0.75) < 1e-9;
  }
  // A fifth each. The ball would come at y = 1.2 - 0.28 * 2.5.
  EXPECT_NEAR(none, kDecisions / 5, kDecisions / 25);
  EXPECT_NEAR(blocks, kDecisions / 5, kDecisions / 25);
  EXPECT_NEAR(ends, kDecisions / 5, kDecisions / 25);
  EXPECT_NEAR(intercepts, kDecisions / 5, kDecisions / 25);
}

// It is one of the others for 0.8 s: of 20 decisions in a row all are to stay, or none.
TEST(KeeperPolicy, MixedKeepsToOneForSomeTime) {
  KeeperMind mind(KeeperPolicy::kMixed, kLine);
  Random random(2);
  int changes = 0;
  bool stood = false;
  for (int turn = 0; turn < 200; ++turn) {
    int none = 0;
    for (int i = 0; i < 20; ++i)
      none += !mind.decide((20 * turn + i) * 40'000, 0.0, std::nullopt, random);
    ASSERT_TRUE(none == 0 || none == 20) << none;
    changes += turn > 0 && stood != (none == 20) ? 1 : 0;
    stood = none == 20;
  }
  // From one turn to the next it changes in 2 * 1/5 * 4/5 of the cases.
  EXPECT_NEAR(changes, 64, 30);
}

}  // namespace
}  // namespace ortung

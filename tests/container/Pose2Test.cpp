#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "ortung/base/Pose2.hpp"
#include "ortung/base/Random.hpp"
#include "ortung/base/Time.hpp"

namespace ortung {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

TEST(WrapAngle, KeepsPiAndTurnsMinusPiIntoPi) {
  EXPECT_EQ(wrapAngle(kPi), kPi);
  EXPECT_EQ(wrapAngle(-kPi), kPi);
  EXPECT_EQ(wrapAngle(0.0), 0.0);
}

TEST(WrapAngle, BringsManyTurnsIntoTheHalfOpenInterval) {
  Random random(1);
  for (int i = 0; i < 10000; ++i) {
    const double angle = random.uniform(-1000.0, 1000.0);
    const double wrapped = wrapAngle(angle);
    EXPECT_GT(wrapped, -kPi);
    EXPECT_LE(wrapped, kPi);
    EXPECT_NEAR(std::cos(wrapped), std::cos(angle), 1e-11);
    EXPECT_NEAR(std::sin(wrapped), std::sin(angle), 1e-11);
  }
}

TEST(WrapAngle, LeavesNotANumberAsItIs) {
  EXPECT_TRUE(std::isnan(wrapAngle(std::nan(""))));
  EXPECT_TRUE(std::isnan(wrapAngle(kInfinity)));
}

TEST(Pose2, ChainsFrames) {
  // By hand: a robot at (1, 2) looking along y carries a sensor 0.5 m ahead that looks back.
  const Pose2 sensor = Pose2{1, 2, kPi / 2} * Pose2{0.5, 0, kPi};
  EXPECT_NEAR(sensor.x, 1.0, 1e-15);
  EXPECT_NEAR(sensor.y, 2.5, 1e-15);
  EXPECT_NEAR(sensor.theta, -kPi / 2, 1e-15);
}

TEST(Pose2, TimesItsInverseIsNothingFromBothSides) {
  Random random(2);
  for (int i = 0; i < 1000; ++i) {
    const Pose2 p{random.uniform(-50, 50), random.uniform(-50, 50), random.uniform(-10, 10)};
    for (const Pose2& unit : {p * inverse(p), inverse(p) * p}) {
      EXPECT_NEAR(unit.x, 0.0, 1e-12);
      EXPECT_NEAR(unit.y, 0.0, 1e-12);
      EXPECT_NEAR(unit.theta, 0.0, 1e-12);
    }
  }
}

TEST(Pose2, CompositionIsAssociative) {
  Random random(3);
  const auto any = [&random] {
    return Pose2{random.uniform(-5, 5), random.uniform(-5, 5), random.uniform(-4, 4)};
  };
  for (int i = 0; i < 1000; ++i) {
    const Pose2 a = any();
    const Pose2 b = any();
    const Pose2 c = any();
    const Pose2 left = (a * b) * c;
    const Pose2 right = a * (b * c);
    EXPECT_NEAR(left.x, right.x, 1e-12);
    EXPECT_NEAR(left.y, right.y, 1e-12);
    EXPECT_NEAR(wrapAngle(left.theta - right.theta), 0.0, 1e-12);
  }
}

TEST(Pose2, KnowsDistanceAndFiniteness) {
  EXPECT_DOUBLE_EQ(distance({0, 0, 1}, {3, 4, -1}), 5.0);
  EXPECT_TRUE(isFinite({1, 2, 3}));
  EXPECT_FALSE(isFinite({std::nan(""), 0, 0}));
  EXPECT_FALSE(isFinite({0, kInfinity, 0}));
  EXPECT_FALSE(isFinite({0, 0, -kInfinity}));
}

TEST(Time, RoundsSecondsToTheNearestMicrosecond) {
  EXPECT_EQ(fromSeconds(1.5), 1500000);
  EXPECT_EQ(fromSeconds(-0.0000014), -1);
  EXPECT_EQ(fromSeconds(0.0000006), 1);
  EXPECT_DOUBLE_EQ(toSeconds(-2500000), -2.5);
}

}  // namespace
}  // namespace ortung

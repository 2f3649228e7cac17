#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "ortung/motion/OdometryTrack.hpp"

namespace ortung {
namespace {

constexpr double kPi = std::numbers::pi;

void expectNear(const Pose2& pose, const Pose2& expected, double tolerance = 1e-9) {
  EXPECT_NEAR(pose.x, expected.x, tolerance);
  EXPECT_NEAR(pose.y, expected.y, tolerance);
  EXPECT_NEAR(wrapAngle(pose.theta - expected.theta), 0.0, tolerance);
}

// A circle of 2 m around the origin: angle t at time t, heading tangential.
Pose2 onCircle(double t) { return {2 * std::cos(t), 2 * std::sin(t), wrapAngle(t + kPi / 2)}; }

TEST(OdometryTrack, IsOnTheArcBetweenAndBesideItsReadings) {
  OdometryTrack track;
  for (const double t : {1.0, 1.4, 2.6, 3.0}) track.add(fromSeconds(t), onCircle(t), 2.0, 1.0);
  for (const double t : {0.75, 1.0, 1.1, 1.4, 2.0, 2.59, 3.0, 3.29}) {
    SCOPED_TRACE(t);
    const auto pose = track.at(fromSeconds(t));
    ASSERT_TRUE(pose);
    expectNear(*pose, onCircle(t));
  }
  expectNear(*track.at(fromSeconds(60)), *track.at(fromSeconds(3.3)));  // no farther than 0.3 s
}

// An omnidirectional robot on the same circle that faces its middle all the time: it drives
// sideways, to the right, and turns. Halfway to the next reading it is where the circle says.
TEST(OdometryTrack, DrivesSidewaysAndTurns) {
  const auto facingTheMiddle = [](double t) {
    return Pose2{2 * std::cos(t), 2 * std::sin(t), wrapAngle(t + kPi)};
  };
  OdometryTrack track;
  for (const double t : {1.0, 1.4, 2.6, 3.0})
    track.add(fromSeconds(t), facingTheMiddle(t), 0.0, 1.0, -2.0);
  for (const double t : {0.75, 1.0, 1.2, 2.0, 2.59, 3.0, 3.1, 3.29}) {
    SCOPED_TRACE(t);
    expectNear(*track.at(fromSeconds(t)), facingTheMiddle(t));
  }
  OdometryTrack straight;
  straight.add(0, {1, 2, kPi / 2}, 0.5, 0.0, 1.0);
  expectNear(*straight.at(200000), {1 - 0.2, 2 + 0.1, kPi / 2});
}

TEST(OdometryTrack, StandsAndDrivesStraight) {
  OdometryTrack track;
  track.add(0, {1, 2, 0.5}, 0, 0);
  track.add(1000000, {1, 2, 0.5}, 0, 0);
  track.add(2000000, Pose2{1, 2, 0.5} * Pose2{1, 0, 0}, 1, 0);
  expectNear(*track.at(500000), {1, 2, 0.5});
  expectNear(*track.at(1250000), Pose2{1, 2, 0.5} * Pose2{0.25, 0, 0});
}

TEST(OdometryTrack, KnowsItsGaps) {
  OdometryTrack track;
  EXPECT_FALSE(track.at(0));
  EXPECT_TRUE(std::isinf(track.gapAt(0)));
  track.add(0, {}, 0, 0);
  track.add(1000000, {}, 0, 0);
  track.add(5000000, {}, 0, 0);
  EXPECT_EQ(track.gapAt(500000), 1.0);
  EXPECT_EQ(track.gapAt(1000000), 4.0);
  EXPECT_EQ(track.gapAt(5000000), 0.0);
  EXPECT_TRUE(std::isinf(track.gapAt(-1)));
  EXPECT_TRUE(std::isinf(track.gapAt(5000001)));
}

TEST(OdometryTrack, ForgetsWhatIsOldAndWhatWasBeforeTheClockWasSetBack) {
  OdometryTrack track(2.0);
  for (int t = 0; t <= 10; ++t) track.add(t * 1000000, {0.1 * t, 0, 0}, 0, 0);
  EXPECT_EQ(track.first(), 7000000);  // one more than 2 s back, to be able to look that far
  track.add(10000000, {5, 0, 0}, 0, 0);
  EXPECT_EQ(track.at(10000000)->x, 5.0);
  track.add(3000000, {7, 0, 0}, 0, 0);
  EXPECT_EQ(track.first(), 3000000);
  EXPECT_EQ(track.last(), 3000000);
  track.clear();
  EXPECT_TRUE(track.empty());
}

}  // namespace
}  // namespace ortung

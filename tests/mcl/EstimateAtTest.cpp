// The estimate at any time, carried on by odometry (and not only as of the newest weighing).
#include <gtest/gtest.h>

#include <cmath>

#include "FakeRun.hpp"
#include "MovingRobot.hpp"
#include "ortung/formats/OdometryData.hpp"
#include "ortung/mcl/Mcl.hpp"

namespace ortung {
namespace {

using test::FakeRun;
using test::kPi;
using test::MovingRobot;

void expectPose(const std::optional<PoseEstimate>& estimate, const Pose2& expected,
                double tolerance = 0.002) {
  ASSERT_TRUE(estimate);
  EXPECT_NEAR(estimate->pose.x, expected.x, tolerance);
  EXPECT_NEAR(estimate->pose.y, expected.y, tolerance);
  EXPECT_NEAR(wrapAngle(estimate->pose.theta - expected.theta), 0.0, tolerance);
}

TEST(EstimateAt, FollowsOdometryThoughNothingIsWeighed) {
  MovingRobot robot;
  const auto mcl = robot.mcl();
  mcl->startAt({1, 0, 0}, 0.0, 0.0);
  robot.odometry(0.0, {{0, 0, 0}, 1.0, 0.0, {}});
  robot.feature("early", 0.0);
  ASSERT_TRUE(mcl->update(robot.container));
  // Five metres to (1 + 5, 0) in pieces of 0.04 m, then a turn on the spot to 2 rad.
  for (int i = 1; i <= 125; ++i) {
    robot.odometry(0.04 * i, {{0.04 * i, 0, 0}, 1.0, 0.0, {}});
    EXPECT_FALSE(mcl->update(robot.container));
    expectPose(mcl->estimate(fromSeconds(0.04 * i)), {1 + 0.04 * i, 0, 0});
    expectPose(mcl->estimate(fromSeconds(0.04 * i - 0.02)), {1 + 0.04 * i - 0.02, 0, 0});
    EXPECT_EQ(mcl->estimate(fromSeconds(0.04 * i - 0.02))->stamp, fromSeconds(0.04 * i - 0.02));
  }
  for (int i = 1; i <= 40; ++i) {
    robot.odometry(5.0 + 0.04 * i, {{5.0, 0, 0.05 * i}, 0.0, 1.25, {}});
    EXPECT_FALSE(mcl->update(robot.container));
  }
  expectPose(mcl->estimate(fromSeconds(6.6)), {6, 0, 2});
  EXPECT_EQ(mcl->estimate().stamp, 0) << "the newest weighing, as ever";
  EXPECT_NEAR(mcl->estimate().pose.x, 1.0, 1e-5);
  // Beyond the newest odometry: at its velocities for 0.3 s, and no farther.
  expectPose(mcl->estimate(fromSeconds(6.8)), {6, 0, 2.25});
  expectPose(mcl->estimate(fromSeconds(6.9)), {6, 0, 2.375});
  expectPose(mcl->estimate(fromSeconds(60)), {6, 0, 2.375});
}

// An omnidirectional robot goes round (0, 0), facing it all the time: sideways, to the right.
TEST(EstimateAt, FollowsARobotThatDrivesSidewaysAndTurns) {
  const auto at = [](double t) {
    return Pose2{2 * std::cos(0.5 * t), 2 * std::sin(0.5 * t), wrapAngle(0.5 * t + kPi)};
  };
  MovingRobot robot;
  const auto mcl = robot.mcl();
  mcl->startAt(at(0), 0.0, 0.0);
  const auto odometry = [&](double t) {
    robot.odometry(t, {inverse(at(0)) * at(t), 0.0, 0.5, {}, -1.0});
  };
  odometry(0.0);
  robot.feature("early", 0.0);
  ASSERT_TRUE(mcl->update(robot.container));
  for (int i = 1; i <= 10; ++i) {  // odometry every 0.2 s, that is 0.2 m: rather seldom
    expectPose(mcl->estimate(fromSeconds(0.2 * i - 0.01)), at(0.2 * i - 0.01));
    expectPose(mcl->estimate(fromSeconds(0.2 * i - 0.1)), at(0.2 * i - 0.1));
    // A reading half way to the next one of odometry is weighed at the right place.
    robot.feature(i % 2 == 1 ? "late" : "early", 0.2 * i - 0.1);
    ASSERT_TRUE(mcl->update(robot.container));
    expectPose(mcl->estimate(), at(0.2 * i - 0.1));
    odometry(0.2 * i);
    mcl->update(robot.container);
    expectPose(mcl->estimate(fromSeconds(0.2 * i)), at(0.2 * i));
  }
}

TEST(EstimateAt, BeginsAtAKnownStartAndWaitsForTheFirstReadingOfAGlobalOne) {
  MovingRobot robot;
  const auto mcl = robot.mcl();
  EXPECT_FALSE(mcl->estimate(0)) << "nothing was started";
  mcl->startGlobal();
  SensorContainer blind;
  blind.add(std::make_unique<OdometryData>(SensorId{"base", "odometry", "pose"}));
  blind.set({0, {"base", "odometry", "pose"}, OdometryData::encode({})});
  mcl->update(blind);
  EXPECT_FALSE(mcl->estimate(0));
  mcl->startAt({3, 2, 1}, 0.1, 0.05);
  const auto start = mcl->estimate(fromSeconds(1.5));
  expectPose(start, {3, 2, 1}, 0.02);
  EXPECT_EQ(start->stamp, fromSeconds(1.5));
  EXPECT_NEAR(start->covariance[0], 0.01, 0.002);
  EXPECT_NEAR(start->covariance[4], 0.01, 0.002);
  EXPECT_NEAR(start->covariance[8], 0.0025, 0.0005);
  mcl->startAt({-4, 1, -2}, 0.1, 0.05);
  expectPose(mcl->estimate(fromSeconds(1.5)), {-4, 1, -2}, 0.02);
}

// Also where it moves along or about one of its axes exactly.
TEST(EstimateAt, FollowsEachAxisByItself) {
  for (const Pose2& change : {Pose2{0.04, 0, 0}, Pose2{0, 0.04, 0}, Pose2{0, 0, 0.02}}) {
    MovingRobot robot;
    const auto mcl = robot.mcl();
    mcl->startAt({0, 0, 0}, 0.0, 0.0);
    robot.odometry(0.0, {});
    robot.feature("early", 0.0);
    ASSERT_TRUE(mcl->update(robot.container));
    const PoseCovariance before = mcl->estimate().covariance;
    robot.odometry(0.1, {change, 0.0, 0.0, {}});
    mcl->update(robot.container);
    expectPose(mcl->estimate(fromSeconds(0.1)), change, 1e-4);
    EXPECT_EQ(mcl->estimate(0)->covariance, before) << "nothing has moved then";
  }
}

// Noise of the motion model widens what is claimed of later times, by its own rule: variances grow
// with the way, sigma 0.1 m after 1 m.
TEST(EstimateAt, GrowsLessCertainAlongTheWay) {
  MovingRobot robot;
  const auto mcl = robot.mcl(OdometryNoise{0, 0, 0.1, 0, 0, 0}, 5000);
  mcl->startAt({0, 0, 0}, 0.0, 0.0);
  robot.odometry(0.0, {{0, 0, 0}, 0.0, 0.0, {}});  // it sets off
  robot.feature("early", 0.0);
  mcl->update(robot.container);
  const double before = mcl->estimate(0)->covariance[0];
  for (int i = 1; i <= 80; ++i) {
    robot.odometry(0.05 * i, {{0.05 * i, 0, 0}, 1.0, 0.0, {}});
    mcl->update(robot.container);
  }
  EXPECT_NEAR(mcl->estimate(fromSeconds(4.0))->covariance[0], 0.01 * 4, 0.003);
  EXPECT_EQ(mcl->estimate().covariance[0], before);
}

// A heading that is off by h puts the robot off by h times the way, sideways.
TEST(EstimateAt, CarriesTheDoubtOfTheHeadingAlong) {
  MovingRobot robot;
  const auto mcl = robot.mcl({0, 0, 0, 0, 0, 0}, 5000);
  mcl->startAt({0, 0, kPi / 2}, 0.0, 0.1);
  robot.odometry(0.0, {{0, 0, 0}, 0.0, 0.0, {}});
  robot.feature("early", 0.0);
  mcl->update(robot.container);
  robot.odometry(1.0, {{0.09, 0, 0}, 0.09, 0.0, {}});  // too little to move samples for
  mcl->update(robot.container);
  const PoseEstimate then = *mcl->estimate(fromSeconds(1.0));
  const double variance = mcl->estimate().covariance[8];
  const double cell = mcl->estimate().covariance[4];  // of the tables
  EXPECT_NEAR(then.pose.y, 0.09, 1e-3);
  EXPECT_NEAR(then.covariance[0] - mcl->estimate().covariance[0], 0.0081 * variance, 1e-6);
  EXPECT_NEAR(then.covariance[4], cell, 1e-5);
  EXPECT_NEAR(then.covariance[2] - mcl->estimate().covariance[2], -0.09 * variance, 1e-5);
  EXPECT_EQ(then.covariance[2], then.covariance[6]);
  EXPECT_EQ(then.covariance[8], variance);
}

// Between two updates, too: what the model says of a way, noise and what odometry gets wrong always
// alike, holds however short it is.
TEST(EstimateAt, KnowsTheMotionModelBetweenUpdates) {
  MovingRobot robot;
  MclConfig config;
  config.maxSamples = config.minSamples = 2000;
  OdometryCorrection correction;
  correction.wayScale = 1.25;
  Mcl mcl(config, robot.region,
          std::make_unique<OdometryMotion>(OdometryNoise{0, 0, 0.1, 0, 0, 0}, correction));
  mcl.startAt({1, 2, kPi / 2}, 0.0, 0.0);
  robot.odometry(0.0, {{0, 0, 0}, 0.8, 0.0, {}});
  robot.feature("early", 0.0);
  mcl.update(robot.container);
  const PoseCovariance before = mcl.estimate().covariance;
  robot.odometry(1.0, {{0.8, 0, 0}, 0.8, 0.0, {}});
  mcl.followOdometry(robot.container);
  const auto then = mcl.estimate(fromSeconds(1.0));
  expectPose(then, {1, 3, kPi / 2}, 0.03);  // the mean of 128 draws of sigma 0.1
  EXPECT_NEAR(then->covariance[4] - before[4], 0.01, 0.004);
  EXPECT_NEAR(then->covariance[0] - before[0], 0.0, 1e-6) << "along the way alone";
  expectPose(mcl.estimate(fromSeconds(0.5)), {1, 2.5, kPi / 2}, 0.02);
  EXPECT_EQ(mcl.samples().y.front(), 2.0F) << "samples wait for the next update";
}

// Whoever asks changes nothing.
TEST(EstimateAt, DoesNotChangeTheFilter) {
  FakeRun asked;
  FakeRun silent;
  const auto one = asked.mcl(asked.config());
  const auto other = silent.mcl(silent.config());
  one->startGlobal();
  other->startGlobal();
  for (FakeRun* run : {&asked, &silent}) run->begin(FakeRun::onCircle(1, 0.5, 0.3), 3);
  for (int i = 0; i < 20; ++i) {
    asked.drive();
    silent.drive();
    one->estimate(asked.stamp);
    one->update(asked.container);
    one->estimate(asked.stamp + 50000);
    other->update(silent.container);
  }
  EXPECT_EQ(one->samples().x, other->samples().x);
  EXPECT_EQ(one->estimate().covariance, other->estimate().covariance);
}

}  // namespace
}  // namespace ortung

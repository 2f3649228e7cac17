// Odometry that stays away while the robot drives on, and comes back.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "FakeRun.hpp"

namespace ortung {
namespace {

/// A robot that knows where it is.
struct Localized {
  explicit Localized(std::uint64_t seed) {
    MclConfig config = run.config();
    config.seed = seed;
    mcl = run.mcl(config);
    const Pose2 start = test::FakeRun::onCircle(0.0, 0.0, 0.7 * static_cast<double>(seed));
    run.begin(start, seed);
    mcl->startAt(start, 0.05, 0.05);
    for (int i = 0; i < 50; ++i) drive();
  }
  void drive() {
    run.drive();
    mcl->update(run.container);
    const PoseEstimate now = mcl->estimate(run.stamp).value();
    error = distance(now.pose, run.truth);
    bound = now.protection.metres;
    worst = std::max(worst, error);
    if (error > bound) ++beyond;
  }

  test::FakeRun run;
  std::unique_ptr<Mcl> mcl;
  double error = 0.0;  ///< of the newest estimate [m]
  double bound = 0.0;  ///< its protection level [m]
  double worst = 0.0;  ///< greatest error so far [m]
  int beyond = 0;      ///< estimates whose error was beyond the level
};

class MissingOdometry : public testing::TestWithParam<std::uint64_t> {
 protected:
  MissingOdometry() : robot(GetParam()) {
    EXPECT_LT(robot.error, 0.1);
    robot.worst = 0.0;
    robot.beyond = 0;
  }
  Localized robot;
};

TEST_P(MissingOdometry, IsMadeUpForByReadings) {
  robot.run.tellsOdometry = false;
  for (int i = 0; i < 60; ++i) robot.drive();
  EXPECT_LT(robot.worst, 0.2);
  EXPECT_EQ(robot.beyond, 0);
}

// Base and odometry have gone on meanwhile, 3 m, which readings have told already.
TEST_P(MissingOdometry, WhatItHasAddedUpIsNotCountedOnceMore) {
  robot.run.tellsOdometry = false;
  for (int i = 0; i < 60; ++i) robot.drive();
  robot.run.tellsOdometry = true;
  robot.worst = 0.0;
  for (int i = 0; i < 30; ++i) robot.drive();
  EXPECT_LT(robot.worst, 0.15);
  EXPECT_EQ(robot.beyond, 0);
}

TEST_P(MissingOdometry, ItsWholeChangeCountsIfNothingElseWasHeard) {
  robot.run.tellsOdometry = robot.run.reads = false;
  for (int i = 0; i < 20; ++i) robot.drive();
  robot.run.tellsOdometry = true;
  robot.drive();
  EXPECT_LT(robot.error, 0.15) << "by odometry alone, 1 m later";
}

TEST_P(MissingOdometry, UntilReadingsComeTheBoundGrows) {
  robot.run.tellsOdometry = robot.run.reads = false;
  double before = robot.bound;
  for (int i = 0; i < 20; ++i) {
    robot.drive();
    if (i < 4) continue;  // for 0.3 s it is taken to go on as before
    EXPECT_GE(robot.bound, before);
    EXPECT_GE(robot.bound, robot.error) << i;
    before = robot.bound;
  }
  EXPECT_GT(robot.error, 0.3) << "nobody knows where it has gone";
}

INSTANTIATE_TEST_SUITE_P(Seeds, MissingOdometry, testing::Values(1, 2, 3));

}  // namespace
}  // namespace ortung

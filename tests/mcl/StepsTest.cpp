// Steps of estimates: what is blended, what is announced.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "FakeRun.hpp"
#include "Steps.hpp"

namespace ortung {
namespace {

using test::kPi;
constexpr double kDegree = kPi / 180.0;

PoseEstimate told(const Steps& steps, const Pose2& pose, double seconds) {
  PoseEstimate estimate;
  estimate.pose = pose;
  estimate.stamp = fromSeconds(seconds);
  steps.apply(estimate);
  return estimate;
}

/// An update at second 1 that moves the pose.
Steps stepped(const Pose2& before, const Pose2& after,
              Relocalization cause = Relocalization::kNone) {
  Steps steps;
  steps.expect(before);
  steps.because(cause);
  steps.follow(after, fromSeconds(1.0));
  return steps;
}

TEST(Steps, ACorrectionIsBlendedIn) {
  const Pose2 before{2.0, 1.0, 1.0};
  const Pose2 after{2.06, 1.05, 1.04};
  const Steps steps = stepped(before, after);
  const PoseEstimate at = told(steps, after, 1.0);
  EXPECT_NEAR(distance(at.smooth, before), 0.0, 1e-12) << "it goes on where it was";
  EXPECT_NEAR(at.smooth.theta, before.theta, 1e-12);
  EXPECT_EQ(at.relocalizations, 0U);
  EXPECT_EQ(at.relocalization, Relocalization::kNone);
  const double whole = distance(before, after);
  for (const double seconds : {0.1, 0.5, 1.0, 5.0}) {
    const PoseEstimate then = told(steps, after, 1.0 + seconds);
    EXPECT_NEAR(distance(then.smooth, after), whole * std::exp(-seconds / 0.5), 1e-9);
    EXPECT_NEAR(after.theta - then.smooth.theta, 0.04 * std::exp(-seconds / 0.5), 1e-9);
  }
  EXPECT_NEAR(distance(told(steps, after, 0.5).smooth, before), 0.0, 1e-12);
}

// The robot's motion is not blended: what is left of a correction moves along with it.
TEST(Steps, TheSmoothPoseMovesWithTheRobot) {
  const Steps steps = stepped({0.0, 0.05, 0.0}, {0.0, 0.0, 0.0});
  const PoseEstimate then = told(steps, {3.0, 0.0, kPi / 2}, 1.0);
  EXPECT_NEAR(then.smooth.x, 3.0 - 0.05, 1e-12);
  EXPECT_NEAR(then.smooth.y, 0.0, 1e-12);
}

TEST(Steps, WhatIsLeftOfOneAddsUpWithTheNext) {
  Steps steps = stepped({0.0, 0.05, 0.0}, {0.0, 0.0, 0.0});
  steps.expect(Pose2{1.0, 0.0, 0.0});
  steps.follow({1.0, -0.05, 0.0}, fromSeconds(1.5));
  EXPECT_NEAR(told(steps, {1.0, -0.05, 0.0}, 1.5).smooth.y, 0.05 * std::exp(-1.0), 1e-12);
}

TEST(Steps, LargeOnesAreAnnounced) {
  const auto announced = [](const Pose2& before, Relocalization cause) {
    const Pose2 after{1.0, 1.0, 3.1};
    const PoseEstimate now = told(stepped(before, after, cause), after, 1.0);
    if (now.relocalizations == 1U) {
      EXPECT_NEAR(distance(now.smooth, after), 0.0, 1e-12) << "nothing is blended";
    }
    return std::pair(now.relocalizations, now.relocalization);
  };
  using enum Relocalization;
  EXPECT_EQ(announced({1.099, 1.0, 3.1}, kNone), std::pair(0U, kNone));
  EXPECT_EQ(announced({1.101, 1.0, 3.1}, kNone), std::pair(1U, kReadings));
  EXPECT_EQ(announced({1.0, 1.0, 3.1 - 2.9 * kDegree}, kOtherPlace), std::pair(0U, kNone));
  EXPECT_EQ(announced({1.0, 1.0, 3.1 - 3.1 * kDegree}, kNone), std::pair(1U, kReadings));
  EXPECT_EQ(announced({1.0, 1.0, wrapAngle(3.1 + 3.1 * kDegree)}, kDelay), std::pair(1U, kDelay));
  EXPECT_EQ(announced({5.0, 1.0, 3.1}, kOtherPlace), std::pair(1U, kOtherPlace));
}

TEST(Steps, AnotherBeliefIsAnnouncedAndHasNothingToBlend) {
  Steps steps = stepped({0.0, 0.05, 0.0}, {0.0, 0.0, 0.0}, Relocalization::kDelay);
  steps.expect(Pose2{});
  steps.begin(Relocalization::kGiven);
  EXPECT_EQ(told(steps, {4.0, 0.0, 0.0}, 1.0).smooth.x, 4.0);
  steps.follow({7.0, 0.0, 0.0}, fromSeconds(1.1));
  const PoseEstimate now = told(steps, {7.0, 0.0, 0.0}, 1.1);
  EXPECT_EQ(now.relocalizations, 1U);
  EXPECT_EQ(now.relocalization, Relocalization::kGiven);
  EXPECT_EQ(now.smooth.x, 7.0);
}

// What is promised, on drives: until the robot is carried away, and when it is.
class StepsOfDrives : public testing::TestWithParam<std::uint64_t> {
 protected:
  void SetUp() override {
    MclConfig config = run.config();
    config.seed = GetParam();
    mcl = run.mcl(config);
    const Pose2 start = test::FakeRun::onCircle(0.0, 0.0, static_cast<double>(GetParam()));
    run.begin(start, GetParam());
    mcl->startAt(start, 0.05, 0.05);
    before = mcl->estimate(run.stamp).value();
    EXPECT_EQ(before.relocalizations, 1U);
    EXPECT_EQ(before.relocalization, Relocalization::kGiven);
  }
  /// One period. Between updates, the pose is where odometry leads.
  void drive() {
    run.drive();
    mcl->followOdometry(run.container);
    const PoseEstimate expected = mcl->estimate(run.stamp).value();
    mcl->update(run.container);
    const PoseEstimate now = mcl->estimate(run.stamp).value();
    const Pose2 step = inverse(expected.pose) * now.pose;
    const Pose2 smooth = inverse(expected.smooth) * now.smooth;
    const bool isStep = std::hypot(step.x, step.y) > 0.10 || std::abs(step.theta) > 3 * kDegree;
    EXPECT_EQ(now.relocalizations - before.relocalizations, isStep ? 1U : 0U);
    if (!isStep) {
      EXPECT_LT(std::hypot(smooth.x, smooth.y), 1e-9);
      EXPECT_LT(std::abs(smooth.theta), 1e-9);
    }
    largest = std::max(largest, std::hypot(step.x, step.y));
    before = now;
  }

  test::FakeRun run;
  std::unique_ptr<Mcl> mcl;
  PoseEstimate before;
  double largest = 0.0;  ///< largest step so far [m]
};

TEST_P(StepsOfDrives, AreAnnouncedExactlyIfTheyAreLarge) {
  for (int i = 0; i < 100; ++i) drive();
  EXPECT_EQ(before.relocalizations, 1U) << "it was never lost";
  EXPECT_GT(largest, 0.003) << "it is corrected all the time";
  EXPECT_LT(distance(before.smooth, run.truth), 0.1);
  run.truth = test::FakeRun::onCircle(-1.0, 0.5, 2.5 + static_cast<double>(GetParam()));
  for (int i = 0; i < 100; ++i) drive();
  EXPECT_LT(distance(before.pose, run.truth), 0.1) << "it is found";
  EXPECT_LT(distance(before.smooth, run.truth), 0.1);
  EXPECT_GT(before.relocalizations, 1U);
  EXPECT_GT(largest, 0.3);
}

INSTANTIATE_TEST_SUITE_P(Seeds, StepsOfDrives, testing::Values(1, 2, 3));

}  // namespace
}  // namespace ortung

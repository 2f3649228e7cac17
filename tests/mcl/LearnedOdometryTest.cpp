// Odometry's errors, learned on the way: against errors that are known.
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "CarriedOn.hpp"
#include "FakeRun.hpp"
#include "LearnedOdometry.hpp"
#include "NoiseRatio.hpp"
#include "PoseMatrix.hpp"
#include "ortung/base/Angles.hpp"
#include "ortung/base/Random.hpp"

namespace ortung {
namespace {

using Vector = Eigen::Vector3d;
using Matrix = Eigen::Matrix3d;

constexpr double kRead = 0.003;  // sigma of what readings say of the pose [m], [rad]

MotionChange changeWith(const Pose2& mean, double sigma) {
  MotionChange change;
  change.mean = mean;
  change.covariance = independent(sigma * sigma, sigma * sigma, sigma * sigma);
  return change;
}

/// A robot whose odometry errs by constant factors, and whose pose is read after each step.
class Drive {
 public:
  explicit Drive(const OdometryErrors& errors, double modelled = 0.02, std::uint64_t seed = 1)
      : errors_(errors), modelled_(modelled), random_(seed) {
    refined = PoseEstimate{};
    refined->covariance = independent(kRead * kRead, kRead * kRead, kRead * kRead);
  }

  /// @param said what odometry says @param isRead whether readings say where the robot is
  void step(const Pose2& said, bool isRead = true) {
    const double way = std::hypot(said.x, said.y);
    truth = truth * Pose2{said.x * (1.0 + errors_.way), said.y * (1.0 + errors_.way),
                          said.theta * (1.0 + errors_.turn) + errors_.veer * way};
    learned.move(changeWith(learned.corrected(said), modelled_), refined);
    if (!isRead) return;
    const Vector off =
        difference({truth.x + read(), truth.y + read(), truth.theta + read()}, refined->pose);
    PoseEstimate alone;
    alone.pose = {refined->pose.x + off.x(), refined->pose.y + off.y(),
                  refined->pose.theta + off.z()};
    alone.covariance = independent(kRead * kRead, kRead * kRead, kRead * kRead);
    learned.compare(alone);
    const Matrix information = Matrix::Identity() / (kRead * kRead);
    const Matrix prior = matrixOf(refined->covariance);
    learned.follow(information * off, information, prior, 1.0, determinesPose);
    const Matrix after = (prior.inverse() + information).inverse();
    const Vector change = after * information * off;
    refined->pose = {refined->pose.x + change.x(), refined->pose.y + change.y(),
                     wrapAngle(refined->pose.theta + change.z())};
    inPlace(refined->covariance) = after;
  }

  /// Drives bends to both sides, and straight on between them.
  void wander(int steps) {
    for (int i = 0; i < steps; ++i)
      step({0.1, 0.0, i / 10 % 3 == 0 ? 0.15 : i / 10 % 3 == 1 ? -0.15 : 0.0});
  }

  LearnedOdometry learned;
  std::optional<PoseEstimate> refined;
  Pose2 truth;
  bool determinesPose = true;  ///< what readings are said to do

 private:
  double read() { return kRead * random_.gaussian(); }
  OdometryErrors errors_;
  double modelled_;
  Random random_;
};

TEST(LearnedOdometry, FindsTheErrorsThatThereAre) {
  const OdometryErrors truth{-0.18, 0.12, 0.05, 1.0};
  Drive drive(truth);
  drive.wander(600);
  const OdometryErrors found = drive.learned.errors();
  EXPECT_NEAR(found.way, truth.way, 0.01);
  EXPECT_NEAR(found.turn, truth.turn, 0.02);
  EXPECT_NEAR(found.veer, truth.veer, 0.01);
  const Pose2 corrected = drive.learned.corrected({1.0, 0.0, 0.5});
  EXPECT_NEAR(corrected.x, 0.82, 0.01);
  EXPECT_NEAR(corrected.theta, 0.5 * 1.12 + 0.05, 0.02);
}

TEST(LearnedOdometry, LeavesOdometryThatIsRightAsItIs) {
  Drive drive({});
  drive.wander(600);
  const OdometryErrors found = drive.learned.errors();
  EXPECT_NEAR(found.way, 0.0, 0.01);
  EXPECT_NEAR(found.turn, 0.0, 0.02);
  EXPECT_NEAR(found.veer, 0.0, 0.01);
  EXPECT_EQ(drive.learned.corrected({}).x, 0.0);
}

// Distances that are all too long by a share are explained by ways that are, too.
TEST(LearnedOdometry, LearnsNothingFromReadingsThatDetermineNoPose) {
  Drive drive({-0.1, 0.0, 0.0, 1.0});
  drive.determinesPose = false;
  drive.wander(100);
  EXPECT_EQ(drive.learned.errors().way, 0.0);
}

// Of a way that was never turned on nothing is known of turns.
TEST(LearnedOdometry, KnowsNothingOfMotionsThatItHasNotSeen) {
  Drive drive({0.1, 0.1, 0.0, 1.0});
  for (int i = 0; i < 300; ++i) drive.step({0.1, 0.0, 0.0});
  const OdometryErrors found = drive.learned.errors();
  EXPECT_NEAR(found.way, 0.1, 0.01);
  EXPECT_NEAR(found.turn, 0.0, 0.01);  // 10 % would be right
}

// A scale that is not known yet makes a way without readings uncertain in proportion to its length,
// not to its root: errors of its pieces are the same ones. Errors within two sigmas of it.
TEST(LearnedOdometry, PiecesOfAWayErrTogether) {
  const auto uncertaintyAfter = [](int pieces) {
    LearnedOdometry learned;
    std::optional<PoseEstimate> pose = PoseEstimate{};
    for (int i = 0; i < pieces; ++i) learned.move(changeWith({2.0 / pieces, 0, 0}, 0.0), pose);
    return std::sqrt(pose->covariance[0]);
  };
  EXPECT_NEAR(uncertaintyAfter(1), 2.0 * 0.05, 1e-3);
  EXPECT_NEAR(uncertaintyAfter(20), uncertaintyAfter(1), 2e-3);
}

// After 5 m without a reading the robot is where the covariance says: Monte Carlo over errors that
// are drawn from what is assumed of them.
TEST(LearnedOdometry, WaysWithoutReadingsAreAsUncertainAsTheyErr) {
  Random random(7);
  double squares = 0.0;
  constexpr int kDrives = 200;
  for (int i = 0; i < kDrives; ++i) {
    const OdometryErrors errors{0.05 * random.gaussian(), 0.05 * random.gaussian(),
                                0.01 * random.gaussian(), 1.0};
    Drive drive(errors, 1e-4, static_cast<std::uint64_t>(i));
    for (int k = 0; k < 50; ++k) drive.step({0.1, 0.0, k < 25 ? 0.05 : -0.02}, false);
    const Vector off(drive.truth.x - drive.refined->pose.x, drive.truth.y - drive.refined->pose.y,
                     wrapAngle(drive.truth.theta - drive.refined->pose.theta));
    const Matrix covariance = matrixOf(drive.refined->covariance);
    squares += off.dot(covariance.inverse() * off) / kDrives;
  }
  EXPECT_GT(squares, 2.0);  // three degrees of freedom
  EXPECT_LT(squares, 4.5);
}

// What readings say of the pose is said of the errors, too, and then the way back is known better.
TEST(LearnedOdometry, WhatIsKnownMakesTheNextWayMoreCertain) {
  Drive drive({-0.1, 0.0, 0.0, 1.0});
  EXPECT_EQ(drive.learned.expected(changeWith({1, 0, 0}, 0.1)).covariance[0], 0.1 * 0.1);
  drive.wander(300);
  const MotionChange next = drive.learned.expected(changeWith({1, 0, 0}, 0.1));
  EXPECT_LT(std::sqrt(next.covariance[0]), 0.03);
  EXPECT_EQ(next.mean.x, 1.0);  // it is a corrected change already
}

// What is not looked at drifts, but is known no worse than it was before anything was known.
TEST(LearnedOdometry, ForgetsNoMoreThanItHasLearned) {
  Drive drive({});
  const auto sigmaOfAMetre = [&] {
    return std::sqrt(drive.learned.expected(changeWith({1.0, 0.0, 0.0}, 0.0)).covariance[0]);
  };
  drive.step({0.01, 0.0, 0.0});
  const double atFirst = sigmaOfAMetre();
  drive.wander(600);
  const double learned = sigmaOfAMetre();
  EXPECT_LT(learned, 0.3 * atFirst);
  const auto drivesOn = [&](int steps) {
    for (int i = 0; i < steps; ++i) drive.step({0.1, 0.0, 0.1}, false);
  };
  drivesOn(100);
  EXPECT_GT(sigmaOfAMetre(), learned);
  drivesOn(100'000);
  EXPECT_NEAR(sigmaOfAMetre(), atFirst, 0.01 * atFirst);
}

// When the belief is another one, the robot is the same.
TEST(LearnedOdometry, StaysWhenTheBeliefIsAnotherOne) {
  Drive drive({-0.1, 0.0, 0.0, 1.0});
  drive.wander(300);
  const OdometryErrors before = drive.learned.errors();
  drive.learned.forgetPose();
  // A pose that has nothing to do with the one before teaches nothing of the way in between.
  const Matrix information = Matrix::Identity() / (kRead * kRead);
  drive.learned.follow(information * Vector(3, 3, 1), information, Matrix::Identity(), 1.0, true);
  EXPECT_EQ(drive.learned.errors().way, before.way);
  EXPECT_EQ(drive.learned.errors().noise, before.noise);
}

TEST(LearnedOdometry, WhatIsNoNumberChangesNothing) {
  Drive drive({-0.1, 0.0, 0.0, 1.0});
  drive.wander(30);
  const OdometryErrors before = drive.learned.errors();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  drive.learned.follow(Vector(nan, 0, 0), Matrix::Identity(), Matrix::Identity(), 1.0, true);
  drive.learned.follow(Vector(1, 1, 1), Matrix::Identity(), Matrix::Zero(), 1.0, true);
  EXPECT_EQ(drive.learned.errors().way, before.way);
}

TEST(LearnedOdometry, BelievesNoErrorThatIsAbsurd) {
  Drive drive({4.0, 4.0, 2.0, 1.0});
  drive.wander(300);
  EXPECT_EQ(drive.learned.errors().way, 0.5);
  EXPECT_LE(std::abs(drive.learned.errors().turn), 0.5);
  EXPECT_LE(std::abs(drive.learned.errors().veer), 0.3);
}

TEST(NoiseRatio, FindsTheFactorOfWhatOdometryErrs) {
  for (const double truth : {1.0, 0.25, 1.0 / 32}) {
    NoiseRatio ratio;
    Random random(3);
    const Matrix motion = Vector(4e-4, 4e-4, 1e-4).asDiagonal();
    const Matrix rest = 1e-6 * Matrix::Identity();
    for (int i = 0; i < 500; ++i) {
      const Matrix all = truth * motion + rest;
      const Vector off(std::sqrt(all(0, 0)) * random.gaussian(),
                       std::sqrt(all(1, 1)) * random.gaussian(),
                       std::sqrt(all(2, 2)) * random.gaussian());
      ratio.follow(off, motion, rest);
    }
    EXPECT_GT(ratio.value(), 0.7 * truth) << truth;
    EXPECT_LT(ratio.value(), 1.4 * truth) << truth;
  }
}

// Where readings scatter more than odometry, they say nothing of it: it stays what the model says.
TEST(NoiseRatio, KeepsTheModelsNoiseAsLongAsNothingIsKnown) {
  NoiseRatio ratio;
  Random random(4);
  const Matrix motion = 1e-6 * Matrix::Identity();
  const Matrix rest = 1e-2 * Matrix::Identity();
  for (int i = 0; i < 300; ++i)
    ratio.follow(0.1 * Vector(random.gaussian(), random.gaussian(), random.gaussian()), motion,
                 rest);
  EXPECT_GT(ratio.value(), 0.9);
}

// One step that a wheel slips counts a little; a floor on which all do is learned again.
TEST(NoiseRatio, LearnsWorseOdometryAgain) {
  NoiseRatio ratio;
  const Matrix motion = 1e-4 * Matrix::Identity();
  const Matrix rest = 1e-8 * Matrix::Identity();
  for (int i = 0; i < 200; ++i) ratio.follow(Vector(1e-3, -1e-3, 1e-3), motion, rest);
  const double good = ratio.value();
  EXPECT_LT(good, 0.05);
  ratio.follow(Vector(0.5, 0, 0), motion, rest);
  EXPECT_LT(ratio.value(), 2.0 * good);
  for (int i = 0; i < 200; ++i) ratio.follow(Vector(0.015, -0.015, 0.015), motion, rest);
  EXPECT_GT(ratio.value(), 0.9);
  ratio.follow(Vector(std::numeric_limits<double>::quiet_NaN(), 0, 0), motion, rest);
  EXPECT_TRUE(std::isfinite(ratio.value()));
}

// The whole filter: wheels that are 15 % larger than odometry thinks.
TEST(LearnedOdometry, ARobotWithWrongWheelsIsFollowedBetweenItsScans) {
  const auto errorOf = [](bool learns) {
    test::FakeRun run;
    MclConfig config = run.config();
    config.learnsOdometry = learns;
    const auto mcl = run.mcl(config);
    run.begin({-1.0, -0.5, 0.3}, 5);
    mcl->startAt(run.truth, 0.05, 0.05);
    run.odometryScale = 1.0 / 1.15;
    for (int i = 0; i < 200; ++i) {
      run.drive(0.4, 0.5);
      mcl->update(run.container);
    }
    if (learns) EXPECT_NEAR(mcl->odometryErrors().way, 0.15, 0.03);
    if (!learns) EXPECT_EQ(mcl->odometryErrors().way, 0.0);
    // A second without scans.
    run.reads = false;
    for (int i = 0; i < 10; ++i) {
      run.drive(0.4, 0.5);
      mcl->update(run.container);
    }
    return distance(mcl->estimate(run.stamp)->pose, run.truth);
  };
  EXPECT_LT(errorOf(true), 0.02);
  EXPECT_GT(errorOf(false), 0.04);
}

}  // namespace
}  // namespace ortung

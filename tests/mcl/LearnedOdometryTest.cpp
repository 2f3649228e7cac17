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
#include "Drift.hpp"
#include "FakeRun.hpp"
#include "LearnedOdometry.hpp"
#include "OdometryModels.hpp"
#include "PoseMatrix.hpp"
#include "ScaledNoise.hpp"
#include "ortung/base/Angles.hpp"
#include "ortung/base/InstructionSet.hpp"
#include "ortung/base/Random.hpp"
#include "ortung/motion/OdometryMotion.hpp"

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
    const Pose2 frame{errors_.ahead, 0.0, errors_.turned};
    truth = truth * inverse(frame) *
            Pose2{said.x * (1.0 + errors_.way), said.y * (1.0 + errors_.way),
                  said.theta * (1.0 + errors_.turn) + errors_.veer * way} *
            frame;
    learned.move(changeWith(learned.corrected(said), modelled_), refined);
    if (!isRead) return;
    const Vector off =
        difference({truth.x + read(), truth.y + read(), truth.theta + read()}, refined->pose);
    PoseEstimate alone;
    alone.pose = {refined->pose.x + off.x(), refined->pose.y + off.y(),
                  refined->pose.theta + off.z()};
    alone.covariance = independent(kRead * kRead, kRead * kRead, kRead * kRead);
    if (determinesPose) learned.compare(alone);
    const Matrix information = Matrix::Identity() / (kRead * kRead);
    const Matrix prior = matrixOf(refined->covariance);
    learned.follow(information, prior, 1.0);
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
  const OdometryErrors truth{-0.18, 0.12, 0.05, 0.08, -0.03, 1.0};
  Drive drive(truth);
  drive.wander(600);
  const OdometryErrors found = drive.learned.errors();
  EXPECT_NEAR(found.way, truth.way, 0.01);
  EXPECT_NEAR(found.turn, truth.turn, 0.02);
  EXPECT_NEAR(found.veer, truth.veer, 0.01);
  EXPECT_NEAR(found.ahead, truth.ahead, 0.01);
  const double turn = 0.5 * 1.12 + 0.05;
  const Pose2 corrected = drive.learned.corrected({1.0, 0.0, 0.5});
  EXPECT_NEAR(found.turned, truth.turned, 0.01);
  EXPECT_NEAR(corrected.x, 0.82 + 0.08 * (std::cos(turn) - 1.0), 0.01);
  EXPECT_NEAR(corrected.y, 0.08 * std::sin(turn) + 0.03 * 0.82, 0.02);
  EXPECT_NEAR(corrected.theta, turn, 0.02);
}

TEST(LearnedOdometry, LeavesOdometryThatIsRightAsItIs) {
  Drive drive({});
  drive.wander(600);
  const OdometryErrors found = drive.learned.errors();
  EXPECT_NEAR(found.way, 0.0, 0.01);
  EXPECT_NEAR(found.turn, 0.0, 0.02);
  EXPECT_NEAR(found.veer, 0.0, 0.01);
  EXPECT_NEAR(found.ahead, 0.0, 0.01);
  EXPECT_EQ(drive.learned.corrected({}).x, 0.0);
}

// Of a way that was never turned on nothing is known of turns.
TEST(LearnedOdometry, KnowsNothingOfMotionsThatItHasNotSeen) {
  Drive drive({0.1, 0.1, 0.0, 0.0, 0.0, 1.0});
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
                                0.03 * random.gaussian(), 0.1 * random.gaussian(),
                                0.02 * random.gaussian(), 1.0};
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
  Drive drive({-0.1, 0.0, 0.0, 0.0, 0.0, 1.0});
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
  const double atFirst = 0.05;
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
  Drive drive({-0.1, 0.0, 0.0, 0.0, 0.0, 1.0});
  drive.wander(300);
  const OdometryErrors before = drive.learned.errors();
  drive.learned.forgetPose();
  // A pose that has nothing to do with the one before teaches nothing of the way in between.
  PoseEstimate elsewhere;
  elsewhere.pose = {3, 3, 1};
  elsewhere.covariance = independent(1e-4, 1e-4, 1e-4);
  drive.learned.compare(elsewhere);
  EXPECT_EQ(drive.learned.errors().way, before.way);
  EXPECT_EQ(drive.learned.errors().noise, before.noise);
}

// A wheel that slips once is no wheel of another size: 0.8 m of 5 m look like 16 %.
TEST(LearnedOdometry, LearnsLittleFromASlip) {
  Drive drive({0.02, 0.0, 0.0, 0.0, 0.0, 1.0});
  drive.wander(300);
  const OdometryErrors before = drive.learned.errors();
  drive.truth = drive.truth * inverse(Pose2{0.8, 0.0, 0.0});
  drive.wander(15);
  EXPECT_NEAR(drive.learned.errors().way, before.way, 0.025);
}

TEST(OdometryModels, WhatIsNoNumberChangesNothing) {
  OdometryModels models;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  OdometryModels::Effect effect = OdometryModels::Effect::Zero();
  effect(0, 0) = 1.0;
  const OdometryModels::Seen notFinite{Vector(nan, 0, 0), effect, models.errors(),
                                       Matrix::Identity(), Matrix::Identity()};
  const OdometryModels::Seen impossible{Vector(1, 1, 1), effect, models.errors(), Matrix::Zero(),
                                        Matrix::Zero()};
  for (const OdometryModels::Seen& seen : {notFinite, impossible}) {
    models.followErrors(seen);
    models.followNoise(seen);
  }
  EXPECT_FALSE(models.isLearned());
  EXPECT_EQ(models.errors()[0], 0.0);
  EXPECT_EQ(models.noise(), OdometryModels().noise());
}

TEST(OdometryModels, BelieveNoErrorThatIsAbsurd) {
  OdometryModels models;
  OdometryModels::Effect effect = OdometryModels::Effect::Zero();
  effect.leftCols<3>().setIdentity();
  const Matrix motion = 0.1 * Matrix::Identity();
  for (int i = 0; i < 5000; ++i)
    models.followErrors(
        {Vector(4, 4, 2) - models.errors().head<3>(), effect, models.errors(), motion, motion});
  EXPECT_EQ(models.errors()[0], 0.5);
  EXPECT_EQ(models.errors()[1], 0.5);
  EXPECT_LE(models.errors()[2], 0.3 + 1e-9);
}

// Errors and noise at once: neither is known before the other is.
TEST(OdometryModels, FindErrorsAndTheFactorOfTheNoise) {
  for (const double truth : {3.0, 1.0, 0.25, 1.0 / 32}) {
    OdometryModels models;
    Random random(3);
    const Matrix motion = Vector(4e-4, 4e-4, 1e-4).asDiagonal();
    const Matrix rest = 1e-6 * Matrix::Identity();
    const OdometryModels::Errors errors{-0.06, 0.04, 0.03, 0.07, -0.02};
    for (int i = 0; i < 500; ++i) {
      OdometryModels::Effect effect = OdometryModels::Effect::Zero();
      const double turn = i % 3 - 1.0;
      effect.row(0) << 1.0, 0.0, 0.0, std::cos(turn) - 1.0, 0.0;
      effect.row(1) << 0.0, 0.0, 0.0, std::sin(turn), -1.0;
      effect.row(2) << 0.0, turn, 1.0, 0.0, 0.0;
      const Matrix all = truth * motion + rest;
      Vector off;  // one by one: compilers choose the order of arguments
      for (const int k : {2, 1, 0}) off(k) = std::sqrt(all(k, k)) * random.gaussian();
      // Odometry is corrected by what is known already.
      const OdometryModels::Seen seen{effect * (errors - models.errors()) + off, effect,
                                      models.errors(), motion, rest};
      models.followNoise(seen);
      models.followErrors(seen);
      models.drift(1.0, turn);
    }
    EXPECT_GT(models.noise(), 0.7 * truth) << truth;
    EXPECT_LT(models.noise(), 1.4 * truth) << truth;
    const OdometryModels::Errors apart = models.errors() - errors;
    const double squares = apart.dot(models.covariance().inverse() * apart);
    EXPECT_LT(squares, 16.0) << truth << ": " << models.errors().transpose();
    EXPECT_LT(apart.cwiseAbs().maxCoeff(), 0.015) << truth;
  }
}

// Where readings scatter more than odometry, they say nothing of it: it stays what the model says.
TEST(OdometryModels, KeepTheModelsNoiseAsLongAsNothingIsKnown) {
  OdometryModels models;
  Random random(4);
  const Matrix motion = 1e-6 * Matrix::Identity();
  const Matrix rest = 1e-2 * Matrix::Identity();
  for (int i = 0; i < 300; ++i)
    models.followNoise({0.1 * Vector(random.gaussian(), random.gaussian(), random.gaussian()),
                        OdometryModels::Effect::Zero(), models.errors(), motion, rest});
  EXPECT_GT(models.noise(), 0.9);
  EXPECT_LT(models.noise(), 1.1);
}

// One step that a wheel slips counts a little; a floor on which all do is learned again.
TEST(OdometryModels, LearnWorseOdometryAgain) {
  OdometryModels models;
  const OdometryModels::Effect none = OdometryModels::Effect::Zero();
  const Matrix motion = 1e-4 * Matrix::Identity();
  const Matrix rest = 1e-8 * Matrix::Identity();
  for (int i = 0; i < 200; ++i)
    models.followNoise({Vector(1e-3, -1e-3, 1e-3), none, models.errors(), motion, rest});
  const double good = models.noise();
  EXPECT_LT(good, 0.05);
  models.followNoise({Vector(0.5, 0, 0), none, models.errors(), motion, rest});
  EXPECT_LT(models.noise(), 2.0 * good);
  for (int i = 0; i < 200; ++i)
    models.followNoise({Vector(0.015, -0.015, 0.015), none, models.errors(), motion, rest});
  EXPECT_GT(models.noise(), 0.9);
}

// Samples: the spread of the motion model, seven of eight narrower by the root of the factor, and
// not otherwise.
TEST(ScaledNoise, NarrowsSevenOfEightSamples) {
  constexpr std::size_t kCount = 80'000;
  const OdometryMotion motion(OdometryNoise{0.2, 0.1, 0.1, 0.1});
  const auto spreadOf = [&](double noise, bool ofAllNoise) {
    SampleSet set;
    set.resize(kCount);
    for (std::size_t i = 0; i < kCount; ++i) set.theta[i] = 0.5F;
    const Pose2 change{1.0, 0.2, 0.7};
    sampleMotion(motion, MovableSamples{set.x, set.y, set.theta}, change, change, noise, 5, 6, 0);
    const Pose2 expected = Pose2{0.0, 0.0, 0.5} * change;
    Vector squares = Vector::Zero();
    double n = 0.0;
    for (std::size_t i = 0; i < kCount; ++i) {
      if ((i % 8 == 0) != ofAllNoise) continue;
      const Vector off = difference({set.x[i], set.y[i], set.theta[i]}, expected);
      squares += off.cwiseAbs2();
      n += 1.0;
    }
    return Vector((squares / n).cwiseSqrt());
  };
  const Vector whole = spreadOf(1.0, false);
  const Vector narrow = spreadOf(1.0 / 16.0, false);
  const Vector rest = spreadOf(1.0 / 16.0, true);
  for (int k = 0; k < 3; ++k) {
    EXPECT_NEAR(narrow[k] / whole[k], 0.25, 0.01) << k;
    EXPECT_NEAR(rest[k] / whole[k], 1.0, 0.03) << k;
  }
}

// A model that corrects odometry keeps its mean.
TEST(ScaledNoise, NarrowsToTheModelsMean) {
  SampleSet set;
  set.resize(800);
  OdometryCorrection correction;
  correction.wayScale = 1.2;
  const OdometryMotion motion(OdometryNoise{0.0, 0.0, 0.1, 0.0}, correction);
  sampleMotion(motion, MovableSamples{set.x, set.y, set.theta}, {1.0, 0.0, 0.0}, {1.2, 0.0, 0.0},
               1e-6, 1, 2, 1);
  for (std::size_t i = 0; i < set.size(); ++i) {
    if ((i + 1) % 8 == 0) continue;
    EXPECT_NEAR(set.x[i], 1.2, 1e-3);
  }
}

// A turn over the angle at which headings wrap is no large error.
TEST(ScaledNoise, HeadingsMayWrap) {
  SampleSet set;
  set.resize(1000);
  for (float& theta : set.theta) theta = 3.0F;
  const OdometryMotion motion(OdometryNoise{0.05, 0.0, 0.0, 0.0});
  const Pose2 turn{0.0, 0.0, 0.3};
  sampleMotion(motion, MovableSamples{set.x, set.y, set.theta}, turn, turn, 0.5, 1, 2, 1);
  for (const float theta : set.theta)
    EXPECT_NEAR(wrapAngle(static_cast<double>(theta) - 3.3), 0.0, 0.2);
}

TEST(ScaledNoise, AndDriftMoveByTheSameBitsWithAnyInstructions) {
  const OdometryMotion motion(OdometryNoise{0.2, 0.1, 0.1, 0.1});
  const auto moved = [&](InstructionSet set) {
    useInstructionSet(set);
    SampleSet samples;
    samples.resize(2049);
    for (std::size_t i = 0; i < samples.size(); ++i)
      samples.theta[i] = 0.01F * static_cast<float>(i) - 9.0F;
    const MovableSamples all{samples.x, samples.y, samples.theta};
    const Pose2 change{1.0, 0.2, 0.7};
    sampleMotion(motion, all, change, change, 0.3, 5, 6, 3);
    drift(MclConfig(), all, change, 0.5, 7, 3);
    useInstructionSet(std::nullopt);
    std::vector<float> values = samples.x;
    values.insert(values.end(), samples.y.begin(), samples.y.end());
    values.insert(values.end(), samples.theta.begin(), samples.theta.end());
    return values;
  };
  const std::vector<float> portable = moved(InstructionSet::kPortable);
  for (const InstructionSet set : {InstructionSet::kAvx2, InstructionSet::kAvx512})
    if (hasInstructionSet(set)) {
      EXPECT_EQ(moved(set), portable) << static_cast<int>(set);
    }
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
    EXPECT_NEAR(mcl->odometryErrors().way, learns ? 0.15 : 0.0, learns ? 0.03 : 0.0);
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

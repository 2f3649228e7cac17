#include <gtest/gtest.h>

#include <cmath>

#include "ortung/base/Random.hpp"
#include "ortung/motion/OdometryMotion.hpp"

namespace ortung {
namespace {

/// A robot that errs as it is told, with a truth that is measured with noise of its own.
struct Synthetic {
  OdometryNoise noise{
      .turnPerTurn = 0.1, .turnPerMetre = 0.05, .wayPerMetre = 0.04, .wayPerTurn = 0.02};
  OdometryCorrection correction;
  double truthMetres = 0.0;   ///< sigma of the truth [m]
  double truthRadians = 0.0;  ///< [rad]
  double jumps = 0.0;         ///< share of truth that is nonsense
};

void teach(OdometryMotion& model, const Synthetic& robot, std::size_t pairs, std::uint64_t seed) {
  Random random(seed);
  Pose2 truth;
  Pose2 seen;
  for (std::size_t i = 0; i < pairs; ++i) {
    // Straight ways, curves and turns on the spot, so that causes can be told apart.
    const double way = i % 3 == 2 ? 0.0 : random.uniform(0.05, 0.3);
    const double turn = i % 3 == 0 ? 0.0 : random.uniform(-0.6, 0.6);
    const Pose2 odometry{way * std::cos(turn / 2), way * std::sin(turn / 2), turn};
    const Pose2 meant = robot.correction.apply(odometry);
    const double moreTurn = std::sqrt(std::pow(robot.noise.turnPerTurn, 2) * std::abs(turn) +
                                      std::pow(robot.noise.turnPerMetre, 2) * way) *
                            random.gaussian();
    const double moreWay = std::sqrt(std::pow(robot.noise.wayPerMetre, 2) * way +
                                     std::pow(robot.noise.wayPerTurn, 2) * std::abs(turn)) *
                           random.gaussian();
    const double direction = meant.theta / 2;
    truth = truth * Pose2{meant.x + moreWay * std::cos(direction),
                          meant.y + moreWay * std::sin(direction), meant.theta + moreTurn};
    Pose2 next{truth.x + robot.truthMetres * random.gaussian(),
               truth.y + robot.truthMetres * random.gaussian(),
               wrapAngle(truth.theta + robot.truthRadians * random.gaussian())};
    if (random.uniform() < robot.jumps) {
      next = {random.uniform(-5, 5), random.uniform(-5, 5), random.uniform(-3, 3)};
    }
    model.learnMotion(odometry, inverse(seen) * next);
    seen = next;
  }
  model.endDrive();
}

void expectNoise(const OdometryNoise& learned, const OdometryNoise& expected, double share) {
  EXPECT_NEAR(learned.turnPerTurn, expected.turnPerTurn, share * expected.turnPerTurn);
  EXPECT_NEAR(learned.turnPerMetre, expected.turnPerMetre, share * expected.turnPerMetre);
  EXPECT_NEAR(learned.wayPerMetre, expected.wayPerMetre, share * expected.wayPerMetre);
  EXPECT_NEAR(learned.wayPerTurn, expected.wayPerTurn, share * expected.wayPerTurn);
}

// 6000 pairs: the sigma of a sigma of one cause is about 1/sqrt(2 n) = 1 %, some times that for two
// that must be told apart.
TEST(MotionLearning, RecoversTheNoiseOfARobot) {
  const Synthetic robot;
  OdometryMotion model;
  teach(model, robot, 6000, 1);
  model.endLearning();
  expectNoise(model.noise(), robot.noise, 0.12);
  EXPECT_LT(model.noise().slipShare, 0.03);
  EXPECT_EQ(model.correction().turnBiasPerMetre, 0.0);  // what could be chance is none
  EXPECT_EQ(model.correction().turnScale, 1.0);
  EXPECT_EQ(model.correction().wayScale, 1.0);
}

// The truth's own noise shows in short pieces alone: it is four times that of the motion there.
TEST(MotionLearning, IsNotFooledByTheNoiseOfTheTruth) {
  const Synthetic robot{.correction = {}, .truthMetres = 0.02, .truthRadians = 0.05};
  OdometryMotion model;
  teach(model, robot, 12000, 2);
  model.endLearning();
  expectNoise(model.noise(), robot.noise, 0.35);
}

TEST(MotionLearning, IsNotFooledByATruthThatJumps) {
  const Synthetic robot{.correction = {}, .jumps = 0.005};
  OdometryMotion model;
  teach(model, robot, 6000, 3);
  model.endLearning();
  expectNoise(model.noise(), robot.noise, 0.25);
}

TEST(MotionLearning, RecoversWhatOdometryAlwaysGetsWrong) {
  const Synthetic robot{.correction = {.wayScale = 1.05,
                                       .turnScale = 0.93,
                                       .turnBiasPerMetre = 0.06,
                                       .wayBiasPerRadian = -0.03}};
  OdometryMotion model;
  teach(model, robot, 6000, 4);
  model.endLearning();
  EXPECT_NEAR(model.correction().wayScale, 1.05, 0.01);
  EXPECT_NEAR(model.correction().turnScale, 0.93, 0.01);
  EXPECT_NEAR(model.correction().turnBiasPerMetre, 0.06, 0.02);  // over seeds, sigma is 0.006
  EXPECT_NEAR(model.correction().wayBiasPerRadian, -0.03, 0.005);
  expectNoise(model.noise(), robot.noise, 0.15);
}

TEST(MotionLearning, TellsModelsApartByTheirLikelihood) {
  const Synthetic robot;
  OdometryMotion right;
  teach(right, robot, 1000, 5);
  Synthetic rough = robot;
  rough.truthRadians = 0.2;
  OdometryMotion wrong;
  teach(wrong, rough, 1000, 5);
  EXPECT_GT(right.endLearning(), wrong.endLearning() + 0.5);
}

TEST(MotionLearning, KeepsWhatADriveSaysNothingAbout) {
  const OdometryNoise before{.turnPerTurn = 0.7, .wayPerTurn = 0.6};
  OdometryMotion model(before);
  Random random(6);
  for (int i = 0; i < 200; ++i)
    model.learnMotion({0.2, 0, 0}, {0.2 + 0.02 * random.gaussian(), 0, 0.01 * random.gaussian()});
  model.endLearning();
  EXPECT_EQ(model.noise().turnPerTurn, 0.7);
  EXPECT_EQ(model.noise().wayPerTurn, 0.6);
  EXPECT_NEAR(model.noise().wayPerMetre, 0.02 / std::sqrt(0.2), 0.01);
}

TEST(MotionLearning, NeedsPairsAndLeavesOutNonsense) {
  OdometryMotion model;
  EXPECT_THROW(model.endLearning(), std::runtime_error);
  for (int i = 0; i < 100; ++i) model.learnMotion({std::nan(""), 0, 0}, {});
  EXPECT_THROW(model.endLearning(), std::runtime_error);
}

TEST(MotionLearning, StandingStillTeachesNothingAndBreaksNothing) {
  OdometryMotion model;
  for (int i = 0; i < 100; ++i) model.learnMotion({}, {});
  EXPECT_TRUE(std::isfinite(model.endLearning()));
  EXPECT_EQ(model.noise().turnPerTurn, OdometryNoise().turnPerTurn);
  EXPECT_EQ(model.correction().wayScale, 1.0);
}

TEST(MotionLearning, SettingsMakeTheSameModelAgain) {
  Synthetic robot;
  robot.correction = {
      .wayScale = 1.1, .turnScale = 0.9, .turnBiasPerMetre = 0.1, .wayBiasPerRadian = -0.05};
  OdometryMotion model;
  teach(model, robot, 500, 7);
  model.endLearning();
  const OdometryMotion again(model.settings());
  EXPECT_DOUBLE_EQ(again.noise().turnPerTurn, model.noise().turnPerTurn);
  EXPECT_DOUBLE_EQ(again.noise().slipShare, model.noise().slipShare);
  EXPECT_DOUBLE_EQ(again.correction().wayScale, model.correction().wayScale);
  EXPECT_NEAR(again.correction().turnBiasPerMetre, model.correction().turnBiasPerMetre, 1e-12);
  EXPECT_DOUBLE_EQ(again.correction().wayBiasPerRadian, model.correction().wayBiasPerRadian);
}

// By hand: 1 m and 0.5 rad become 1.05 m - 0.1 m/rad * 0.5 rad = 1.00 m and 0.9 * 0.5 + 0.04 rad.
TEST(OdometryCorrection, IsAppliedAsItsKeysSay) {
  const OdometryCorrection c{
      .wayScale = 1.05, .turnScale = 0.9, .turnBiasPerMetre = 0.04, .wayBiasPerRadian = -0.1};
  const Pose2 straight = c.apply({1.0, 0.0, 0.0});
  EXPECT_NEAR(straight.x, 1.05 * std::cos(0.02), 1e-12);
  EXPECT_NEAR(straight.theta, 0.04, 1e-12);
  const Pose2 curve = c.apply({std::cos(0.25), std::sin(0.25), 0.5});
  EXPECT_NEAR(std::hypot(curve.x, curve.y), 1.0, 1e-12);
  EXPECT_NEAR(curve.theta, 0.45 + 0.04 * std::cos(0.25), 1e-12);
  EXPECT_NEAR(std::atan2(curve.y, curve.x), 0.25 + 0.5 * (curve.theta - 0.5), 1e-12);
  const Pose2 spot = c.apply({0.0, 0.0, 1.0});  // a turn on the spot has no way to lose
  EXPECT_EQ(spot.x, 0.0);
  EXPECT_NEAR(spot.theta, 0.9, 1e-12);
  const Pose2 tight = c.apply({0.01, 0.0, 1.0});  // at most half of the way
  EXPECT_NEAR(std::hypot(tight.x, tight.y), 0.01 * (1.05 - 0.5), 1e-12);
}

TEST(OdometryCorrection, AScaleOfTheWayAloneIsEnough) {
  const OdometryCorrection c{.wayScale = 1.25};
  const Pose2 change = c.apply({2.0, 1.0, 0.5});
  EXPECT_NEAR(change.x, 2.5, 1e-12);
  EXPECT_NEAR(change.y, 1.25, 1e-12);
  EXPECT_EQ(change.theta, 0.5);
}

TEST(OdometryCorrection, IsCheckedWhenRead) {
  for (const auto& [key, value] :
       {std::pair("way_scale", 3.0), {"turn_scale", 0.0}, {"delay_s", 5.0}}) {
    Parameters p("robot.toml");
    p.set(key, value);
    EXPECT_THROW(OdometryMotion{p}, ConfigError) << key;
  }
}

// Every tenth sample has four times the noise: variance 1 + (16 - 1) / 10 times that of the others.
TEST(OdometryMotion, SlipsWithSomeSamples) {
  constexpr std::size_t kMany = 100000;
  std::vector<float> x(kMany), y(kMany), theta(kMany);
  const OdometryMotion model({.turnPerTurn = 0,
                              .turnPerMetre = 0,
                              .wayPerMetre = 0.1,
                              .wayPerTurn = 0,
                              .floorMetres = 0,
                              .floorRadians = 0,
                              .slipShare = 0.1});
  model.sampleMotion({x, y, theta}, {1, 0, 0}, 1, 0, 0);
  double variance = 0.0;
  for (const float v : x) variance += std::pow(static_cast<double>(v) - 1.0, 2) / kMany;
  EXPECT_NEAR(variance, 0.01 * (1 + 15 * 0.1), 5 * 0.01 * 2.5 * std::sqrt(8.0 / kMany));
  std::vector<float> x2(kMany), y2(kMany), theta2(kMany);
  for (std::size_t first = 0; first < kMany; first += 333) {  // in any pieces
    const std::size_t n = std::min<std::size_t>(333, kMany - first);
    model.sampleMotion({std::span(x2).subspan(first, n), std::span(y2).subspan(first, n),
                        std::span(theta2).subspan(first, n)},
                       {1, 0, 0}, 1, 0, first);
  }
  EXPECT_EQ(x, x2);
}

}  // namespace
}  // namespace ortung

// How a robot goes on of which nobody tells how it moves.
#include <gtest/gtest.h>

#include <cmath>

#include "Drift.hpp"
#include "FakeRun.hpp"
#include "Momentum.hpp"
#include "ortung/mcl/Mcl.hpp"

namespace ortung {
namespace {

using test::FakeRun;

PoseEstimate seen(const Pose2& pose, double variance = 0.0, double varianceTurn = 0.0) {
  PoseEstimate e;
  e.pose = pose;
  e.covariance = {variance, 0, 0, 0, variance, 0, 0, 0, varianceTurn};
  return e;
}

/// On a circle of 2 m, at 1 m/s and 0.5 rad/s.
Pose2 onCircle(double t) {
  return {2 * std::cos(0.5 * t), 2 * std::sin(0.5 * t), wrapAngle(0.5 * t + std::acos(0.0))};
}

void expectNear(const Pose2& a, const Pose2& b, double tolerance) {
  EXPECT_NEAR(a.x, b.x, tolerance);
  EXPECT_NEAR(a.y, b.y, tolerance);
  EXPECT_NEAR(wrapAngle(a.theta - b.theta), 0.0, tolerance);
}

TEST(Momentum, GoesOnOnTheCircleOnWhichTheRobotWasSeen) {
  const MclConfig config;
  Momentum momentum(config);
  expectNear(momentum.changeAt(fromSeconds(5)), {}, 0.0);
  momentum.follow(seen(onCircle(3)), fromSeconds(3));
  expectNear(momentum.changeAt(fromSeconds(4)), {}, 0.0);  // it was seen once
  momentum.follow(seen(onCircle(3.8)), fromSeconds(3.8));
  for (const double t : {3.8, 4.0, 4.3, 4.6})
    expectNear(onCircle(3.8) * momentum.changeAt(fromSeconds(t)), onCircle(t), 0.004);
  // For as long again as it was seen to move so.
  expectNear(onCircle(3.8) * momentum.changeAt(fromSeconds(60)), onCircle(4.6), 0.004);
  expectNear(momentum.changeAt(fromSeconds(3)), {}, 0.0);  // the past
}

TEST(Momentum, CountsWhatWasSeenByHowWellItIsKnown) {
  MclConfig config;
  config.driftMetres = 0.5;   // variance in 2 s: 0.5 m^2
  config.driftRadians = 0.2;  // 0.08
  Momentum momentum(config);
  momentum.follow(seen({0, 0, 0}, 0.1, 0.01), fromSeconds(0));
  momentum.follow(seen({1, 0, 0.2}, 0.4, 0.07), fromSeconds(2));
  const Pose2 change = momentum.changeAt(fromSeconds(4));
  EXPECT_NEAR(std::hypot(change.x, change.y), 0.5, 1e-9) << "half of it";
  EXPECT_NEAR(change.theta, 0.1, 1e-9);
}

TEST(Momentum, IsNoneOfAJump) {
  const MclConfig config;  // 0.5 m, 30 degrees in 1 s
  for (const Pose2& to : {Pose2{2.1, 0, 0}, Pose2{0, 0, 2.2}}) {
    Momentum momentum(config);
    momentum.follow(seen({}), fromSeconds(0));
    momentum.follow(seen(to), fromSeconds(1));
    expectNear(momentum.changeAt(fromSeconds(2)), {}, 0.0);
    momentum.follow(seen(to * Pose2{0.5, 0, 0}), fromSeconds(2));
    expectNear(momentum.changeAt(fromSeconds(3)), {0.5, 0, 0}, 1e-9);  // goes on from there
  }
  Momentum momentum(config);
  momentum.follow(seen({}), fromSeconds(5));
  momentum.follow(seen({0.1, 0, 0}), fromSeconds(5));
  expectNear(momentum.changeAt(fromSeconds(6)), {}, 0.0);
  momentum.follow(seen({0.3, 0, 0}), fromSeconds(4));  // the clock was set back
  expectNear(momentum.changeAt(fromSeconds(5)), {}, 0.0);
  momentum.follow(seen({0.4, 0, 0}), fromSeconds(4.5));
  EXPECT_GT(momentum.changeAt(fromSeconds(5)).x, 0.09);
}

TEST(Drift, GoesAheadInEachSamplesOwnFrame) {
  MclConfig config;
  config.driftMetres = config.driftRadians = 0.0;
  std::vector<float> x{1, 1};
  std::vector<float> y{2, 2};
  std::vector<float> theta{0, static_cast<float>(std::acos(0.0))};
  drift(config, {x, y, theta}, {0.5, 0.25, 0.1}, 1.0, 3, 0);
  EXPECT_NEAR(x[0], 1.5, 1e-6);
  EXPECT_NEAR(y[0], 2.25, 1e-6);
  EXPECT_NEAR(x[1], 0.75, 1e-6);
  EXPECT_NEAR(y[1], 2.5, 1e-6);
  EXPECT_NEAR(theta[0], 0.1, 1e-6);
}

// A scan now and then, and nothing else: between two of them the robot is where it would be if it
// went on. It used to be taken to stand.
TEST(Momentum, CarriesTheEstimateOnBetweenReadings) {
  FakeRun run;
  const auto mcl = run.mcl(run.config());
  run.begin(FakeRun::onCircle(1, 0.5, 0.3), 3);
  mcl->startAt(run.truth, 0.1, 0.1);
  run.tellsOdometry = false;
  double carried = 0.0;
  double standing = 0.0;
  int compared = 0;
  for (int i = 0; i < 200; ++i) {
    run.drive();
    if (i % 5 != 4) continue;  // a reading in 0.5 s is taken, that is in 0.25 m
    if (i > 50) {
      const auto ahead = mcl->estimate(run.stamp);
      ASSERT_TRUE(ahead);
      carried += distance(ahead->pose, run.truth);
      standing += distance(mcl->estimate().pose, run.truth);
      ++compared;
    }
    mcl->update(run.container);
  }
  EXPECT_NEAR(standing / compared, 0.25, 0.05);
  EXPECT_LT(carried / compared, 0.1);
}

}  // namespace
}  // namespace ortung

#include <gtest/gtest.h>

#include <cmath>

#include "RollingBall.hpp"
#include "ortung/base/Random.hpp"
#include "ortung/core/ShippedFiles.hpp"
#include "ortung/sim/Simulation.hpp"

namespace ortung {
namespace {

constexpr double kBraking = 0.03 * 9.81;  // of the shipped fields [m/s^2]

// The physics is the truth: a ball that rolls over the field without touching anything.
TEST(RollingBall, CrossesALineWhereAndWhenItDoesInTheSimulation) {
  Simulation simulation(readWorld(shippedFile("fields", "f2000.toml")), {.cycle = 0.005});
  for (const auto& [vx, vy] : {std::pair{-2.0, 0.5}, {-3.0, -1.0}, {-1.9, 0.0}}) {
    const RollingBall ball{{1.0, 0.3}, vx, vy, kBraking};
    simulation.placeThing(0, {ball.at.x, ball.at.y, 0.0}, {vx, vy, 0.0});
    const auto crossing = ball.crossing(-4.0);
    ASSERT_TRUE(crossing);
    const Timestamp begun = simulation.now();
    Pose2 before = simulation.things()[0].pose;
    while (simulation.things()[0].pose.x > -4.0 && simulation.now() - begun < 10'000'000) {
      before = simulation.things()[0].pose;
      simulation.step();
    }
    const Pose2 after = simulation.things()[0].pose;
    const double share = (before.x + 4.0) / (before.x - after.x);
    EXPECT_NEAR(before.y + share * (after.y - before.y), crossing->y, 0.005) << vx;
    EXPECT_NEAR(toSeconds(simulation.now() - begun) - 0.005 * (1.0 - share), crossing->after,
                0.02 * crossing->after)
        << vx;
  }
}

TEST(RollingBall, DoesNotCrossWhereItStopsBefore) {
  // It comes v^2 / 2b far.
  const double way = 1.5 * 1.5 / (2.0 * kBraking);
  const RollingBall ball{{0.0, 0.0}, -1.5, 0.0, kBraking};
  ASSERT_TRUE(ball.crossing(-way + 1e-6));
  EXPECT_NEAR(ball.crossing(-way + 1e-6)->after, 1.5 / kBraking, 0.01);
  EXPECT_FALSE(ball.crossing(-way - 1e-6));
  EXPECT_FALSE(ball.crossing(1.0)) << "it rolls the other way";
  EXPECT_NEAR(ball.later(100.0).x, -way, 1e-9);
}

TEST(RollingBall, WithoutBrakingItIsAStraightLine) {
  const RollingBall ball{{1.0, 2.0}, -2.0, 1.0, 0.0};
  ASSERT_TRUE(ball.crossing(-3.0));
  EXPECT_DOUBLE_EQ(ball.crossing(-3.0)->y, 4.0);
  EXPECT_DOUBLE_EQ(ball.crossing(-3.0)->after, 2.0);
  EXPECT_DOUBLE_EQ(ball.later(0.5).x, 0.0);
}

/// Where a ball is after some time: by the closed form.
FloorPoint placeOf(double v, double direction, double t) {
  const double way = v * t - 0.5 * kBraking * t * t;
  return {2.0 + way * std::cos(direction), -1.0 + way * std::sin(direction)};
}

TEST(BallTrack, FindsTheVelocityOfABallThatIsBraked) {
  BallTrack track(kBraking);
  for (int i = 0; i <= 10; ++i) track.see(i * 40'000, placeOf(2.5, 2.8, 0.04 * i), 0.0);
  ASSERT_TRUE(track.ball());
  EXPECT_NEAR(track.ball()->speed(), 2.5 - kBraking * 0.4, 1e-4);
  EXPECT_NEAR(std::atan2(track.ball()->speedY, track.ball()->speedX), 2.8, 1e-6);
  EXPECT_NEAR(track.ball()->at.x, placeOf(2.5, 2.8, 0.4).x, 1e-4);
  EXPECT_EQ(track.lastSeen(), 400'000);
}

TEST(BallTrack, ManyPlacesMakeNoiseLess) {
  double squares = 0.0;
  double bare = 0.0;
  constexpr int kBalls = 200;
  for (int b = 0; b < kBalls; ++b) {
    Random random(7, static_cast<std::uint64_t>(b));
    BallTrack track(kBraking, 0.02, BallTrack::kMostNoisy);
    double last = 0.0;
    double before = 0.0;
    for (int i = 0; i <= 10; ++i) {
      FloorPoint at = placeOf(2.5, 0.0, 0.04 * i);
      at.x += 0.02 * random.gaussian();
      at.y += 0.02 * random.gaussian();
      before = last;
      last = at.x;
      track.see(i * 40'000, at, 0.02);
    }
    const double truth = 2.5 - kBraking * 0.4;
    squares += std::pow(track.ball()->speedX - truth, 2) / kBalls;
    bare += std::pow((last - before) / 0.04 - truth, 2) / kBalls;
  }
  // A line through eleven places dt apart has sigma / (dt sqrt(110)).
  EXPECT_NEAR(std::sqrt(squares), 0.02 / (0.04 * std::sqrt(110.0)), 0.01);
  EXPECT_GT(bare, 20.0 * squares);
}

// What is seen from far away is less exact, and counts less.
TEST(BallTrack, ExactPlacesCountMore) {
  double even = 0.0;
  double weighed = 0.0;
  for (int b = 0; b < 200; ++b) {
    Random random(9, static_cast<std::uint64_t>(b));
    BallTrack one(kBraking, 0.0, BallTrack::kMostNoisy);
    BallTrack other(kBraking, 0.0, BallTrack::kMostNoisy);
    for (int i = 0; i < 12; ++i) {
      const double sigma = i < 6 ? 0.1 : 0.01;
      FloorPoint at = placeOf(2.5, 0.0, 0.04 * i);
      at.y += sigma * random.gaussian();
      one.see(i * 40'000, at, 0.1);
      other.see(i * 40'000, at, sigma);
    }
    even += std::pow(one.ball()->at.y + 1.0, 2);
    weighed += std::pow(other.ball()->at.y + 1.0, 2);
  }
  EXPECT_LT(weighed, 0.2 * even);
}

TEST(BallTrack, AKickBeginsAnew) {
  BallTrack track(kBraking);
  int i = 0;
  for (; i < 10; ++i) track.see(i * 40'000, {2.0, 1.0}, 0.0);
  EXPECT_NEAR(track.ball()->speed(), 0.0, 1e-9);
  for (int k = 1; k <= 4; ++k, ++i) track.see(i * 40'000, {2.0 - 0.16 * k, 1.0}, 0.0);
  EXPECT_NEAR(track.ball()->speedX, -4.0, 0.1);
}

}  // namespace
}  // namespace ortung

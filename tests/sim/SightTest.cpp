// Helpers for authors of sensor plugins: rays on the floor, what is visible, noise.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "FakeWorld.hpp"
#include "SensorRig.hpp"
#include "ortung/sim_api/Noise.hpp"
#include "ortung/sim_api/Rays2.hpp"
#include "ortung/sim_api/Sight.hpp"

namespace ortung {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kDegree = kPi / 180.0;  // [rad]

std::vector<double> crossings(const Ray2& ray, const FieldLine& line) {
  std::vector<double> ranges;
  addCrossings(ray, line, ranges);
  std::sort(ranges.begin(), ranges.end());
  return ranges;
}

FieldLine circle(double radius, double from = 0.0, double to = 2.0 * kPi) {
  FieldLine arc;
  arc.shape = FieldLine::Shape::kArc;
  arc.radiusX = arc.radiusY = radius;
  arc.from = from;
  arc.to = to;
  arc.width = 0.1;
  return arc;
}

TEST(Rays2, NothingIsCrossedNearerThanTheLeastRange) {
  Random random(5);
  int crossed = 0;
  double closest = 1e9;  // how much further the nearest crossing is
  for (int i = 0; i < 20'000; ++i) {
    FieldLine line = circle(random.uniform(0.05, 3.0), 0.0, random.uniform(0.5, 2.0 * kPi));
    line.radiusY = random.uniform(0.05, 3.0);
    line.angle = random.uniform(-kPi, kPi);
    if (i % 2 == 0) line.shape = FieldLine::Shape::kStraight;
    if (i % 7 == 0) line.radiusX = line.radiusY = 0.1;  // a spot
    line.x = line.x0 = random.uniform(-5.0, 5.0);
    line.y = line.y0 = random.uniform(-5.0, 5.0);
    line.x1 = random.uniform(-5.0, 5.0);
    line.y1 = random.uniform(-5.0, 5.0);
    const Ray2 ray =
        rayAlong(random.uniform(-5.0, 5.0), random.uniform(-5.0, 5.0), random.uniform(-kPi, kPi));
    const double least = leastRange(ray.x, ray.y, line);
    for (const double range : crossings(ray, line)) {
      EXPECT_GE(range, least - 1e-9);
      closest = std::min(closest, range - least);
      ++crossed;
    }
  }
  EXPECT_GT(crossed, 2000);
  EXPECT_LT(closest, 0.01);  // the bound is not an idle one
}

TEST(Rays2, MeetSegmentsWhereLinesIntersect) {
  // The diagonal meets x = 3 at (3, 3).
  const Ray2 diagonal = rayAlong(0, 0, kPi / 4);
  EXPECT_NEAR(rangeToSegment(diagonal, 3, -1, 3, 5).value(), 3 * std::sqrt(2.0), 1e-12);
  EXPECT_NEAR(rangeToSegment(diagonal, 3, 5, 3, -1).value(), 3 * std::sqrt(2.0), 1e-12);
  EXPECT_FALSE(rangeToSegment(diagonal, 3, -1, 3, 2.9));                           // ends too early
  EXPECT_FALSE(rangeToSegment(diagonal, -3, -5, -3, 5));                           // behind
  EXPECT_FALSE(rangeToSegment(diagonal, 1, 0, 5, 4));                              // parallel
  EXPECT_FALSE(rangeToSegment(diagonal, 2, 2, 2, 2));                              // no length
  EXPECT_NEAR(rangeToSegment(rayAlong(0, 3, 0), 3, 3, 3, 9).value(), 3.0, 1e-12);  // its very end
}

TEST(Rays2, MeetCirclesOnceFromWithinAndTwiceFromOutside) {
  const auto outside = rangesToCircle(rayAlong(-5, 0, 0), 0, 0, 2);
  ASSERT_EQ(outside.size(), 2u);
  EXPECT_NEAR(outside[0], 3.0, 1e-12);
  EXPECT_NEAR(outside[1], 7.0, 1e-12);
  const auto within = rangesToCircle(rayAlong(1, 0, kPi / 2), 0, 0, 2);
  ASSERT_EQ(within.size(), 1u);
  EXPECT_NEAR(within[0], std::sqrt(3.0), 1e-12);
  EXPECT_TRUE(rangesToCircle(rayAlong(-5, 2.1, 0), 0, 0, 2).empty());
  EXPECT_TRUE(rangesToCircle(rayAlong(5, 0, 0), 0, 0, 2).empty());
}

TEST(Rays2, CrossTheMiddleOfPaintedArcs) {
  EXPECT_EQ(crossings(rayAlong(-5, 0, 0), circle(2)).size(), 2u);
  // A quarter from 0 to 90 degrees: along the diagonal once, at radius 2.
  const auto quarter = crossings(rayAlong(0, 0, kPi / 4), circle(2, 0, kPi / 2));
  ASSERT_EQ(quarter.size(), 1u);
  EXPECT_NEAR(quarter[0], 2.0, 1e-12);
  EXPECT_TRUE(crossings(rayAlong(0, 0, -kPi / 4), circle(2, 0, kPi / 2)).empty());
  // The last quarter, told as 270 to 360 degrees.
  EXPECT_EQ(crossings(rayAlong(0, 0, -kPi / 4), circle(2, 1.5 * kPi, 2 * kPi)).size(), 1u);
  // An ellipse of 3 by 1, turned upright: 3 along y.
  FieldLine ellipse = circle(3);
  ellipse.radiusY = 1;
  ellipse.angle = kPi / 2;
  EXPECT_NEAR(crossings(rayAlong(0, 0, kPi / 2), ellipse).at(0), 3.0, 1e-12);
  EXPECT_NEAR(crossings(rayAlong(0, 0, kPi), ellipse).at(0), 1.0, 1e-12);
}

TEST(Rays2, EveryCrossingLiesOnTheEllipse) {
  FieldLine ellipse = circle(2.5);
  ellipse.x = 1.0;
  ellipse.y = -0.5;
  ellipse.radiusY = 0.7;
  ellipse.angle = 0.6;
  int count = 0;
  for (int i = 0; i < 360; ++i) {
    const Ray2 ray = rayAlong(-1.0, 1.0, i * kDegree);
    for (const double range : crossings(ray, ellipse)) {
      const double x = ray.x + range * ray.dx - ellipse.x;
      const double y = ray.y + range * ray.dy - ellipse.y;
      const double u = (std::cos(0.6) * x + std::sin(0.6) * y) / 2.5;
      const double v = (-std::sin(0.6) * x + std::cos(0.6) * y) / 0.7;
      EXPECT_NEAR(u * u + v * v, 1.0, 1e-9);
      ++count;
    }
  }
  EXPECT_GT(count, 50);
}

TEST(Rays2, MeetASpotOnceInItsMiddle) {
  FieldLine spot = circle(0.0375);
  spot.x = 3.0;
  spot.width = 0.075;  // filled
  EXPECT_NEAR(crossings(rayAlong(0, 0.05, 0), spot).at(0), 3.0, 1e-12);
  EXPECT_EQ(crossings(rayAlong(0, 0.05, 0), spot).size(), 1u);
  EXPECT_TRUE(crossings(rayAlong(0, 0.08, 0), spot).empty());
}

TEST(Sight, KeepsToFieldOfViewAndRange) {
  Eye eye{.pose = {1, 1, kPi / 2}, .fieldOfView = 90 * kDegree, .minRange = 0.5, .maxRange = 4.0};
  const auto ahead = lookAt(eye, 1, 3);
  ASSERT_TRUE(ahead);
  EXPECT_NEAR(ahead->range, 2.0, 1e-12);
  EXPECT_NEAR(ahead->bearing, 0.0, 1e-12);
  EXPECT_NEAR(lookAt(eye, 0, 2.5)->bearing, std::atan2(1.0, 1.5), 1e-12);
  EXPECT_FALSE(lookAt(eye, 0, 1.9));  // 48 degrees to the left
  EXPECT_FALSE(lookAt(eye, 1, 1.4));
  EXPECT_FALSE(lookAt(eye, 1, 5.1));
  eye.fieldOfView = 2 * kPi;
  EXPECT_TRUE(lookAt(eye, 1, -2));
}

TEST(Sight, SharesFallAsABodyMovesBehindAnother) {
  FakeWorld room(20, 20);
  room.addPost({2.0, 0.0, 0.25});
  const Eye eye{.pose = {0, 0, 0}};
  WorldObject ball;
  ball.radius = ball.halfX = ball.halfY = 0.25;
  ball.isRound = true;
  ball.pose = {4.0, 0.0, 0.0};
  EXPECT_EQ(visibleShare(room, eye, ball), 0.0);  // the post's shadow is twice as wide
  ball.pose.y = 0.5;  // the shadow's edge, at 4 * 0.25 / sqrt(4 - 1/16), lies at its middle
  EXPECT_NEAR(visibleShare(room, eye, ball), 0.4, 1e-12);  // 2 of 5 sight lines
  ball.pose.y = 1.0;
  EXPECT_EQ(visibleShare(room, eye, ball), 1.0);
}

// Seen steeply from above, a body's own top is nearer than its side.
TEST(Sight, NoBodyHidesItself) {
  FakeWorld room(20, 20);
  const Eye eye{.pose = {0, 0, 0}, .z = 0.7};
  WorldObject ball;
  ball.radius = ball.halfX = ball.halfY = 0.11;
  ball.zHigh = 0.22;
  ball.isRound = true;
  for (double away = 0.15; away < 3.0; away += 0.05) {
    ball.pose = {away, 0.0, 0.0};
    FakeWorld with(20, 20);
    with.addPost({away, 0.0, 0.11});
    EXPECT_EQ(visibleShare(with, eye, ball), 1.0) << away;
  }
}

TEST(Sight, ItsOwnRobotHidesNothing) {
  FakeWorld room(20, 20);
  const RobotNumber robot = room.addRound(0.25, 0.5, 0.0);
  Eye eye;
  EXPECT_FALSE(isVisible(room, eye, 3, 0, 0.5, 0.1));
  eye.robot = robot;
  EXPECT_TRUE(isVisible(room, eye, 3, 0, 0.5, 0.1));
}

TEST(Noise, HasItsParametersStatistics) {
  const SightingNoise noise{.rangeSigma = 0.02,
                            .rangeSigmaPerMetre = 0.03,
                            .bearingSigma = 0.05,
                            .missedShare = 0.2,
                            .falseShare = 0.1};
  Random random(11);
  Statistics ranges;
  Statistics bearings;
  for (int i = 0; i < 10000; ++i) {
    const auto seen = detected({4.0, 0.3}, noise, random);
    if (!seen) continue;
    ranges.add(seen->range);
    bearings.add(seen->bearing);
  }
  EXPECT_NEAR(ranges.count() / 10000.0, 0.8, 0.016);  // 4 sigma of 10000 draws
  EXPECT_NEAR(ranges.mean(), 4.0, 0.0063);            // sigma 0.14: 4 * 0.14 / sqrt(8000)
  EXPECT_NEAR(ranges.sigma(), 0.14, 0.0045);          // 4 * 0.14 / sqrt(16000)
  EXPECT_NEAR(bearings.mean(), 0.3, 0.0023);
  EXPECT_NEAR(bearings.sigma(), 0.05, 0.0016);
  int ghosts = 0;
  const Eye eye{.pose = {}, .fieldOfView = kPi, .minRange = 1.0, .maxRange = 5.0};
  for (int i = 0; i < 10000; ++i) {
    const auto ghost = falseSighting(eye, noise, random);
    if (!ghost) continue;
    ++ghosts;
    EXPECT_TRUE(ghost->range >= 1.0 && ghost->range <= 5.0);
    EXPECT_LE(std::abs(ghost->bearing), kPi / 2);
  }
  EXPECT_NEAR(ghosts / 10000.0, 0.1, 0.012);
}

}  // namespace
}  // namespace ortung

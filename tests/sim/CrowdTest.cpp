#include <gtest/gtest.h>

#include <cmath>
#include <ctime>

#include "BoxShapes.hpp"
#include "Physics.hpp"
#include "ortung/base/Random.hpp"

// Robots of many pieces that overlap cost what they can be worth, not what they ask for.
namespace ortung {
namespace {

constexpr double kCycle = 0.01;

Primitive box(double x, double y, double angle, double size) {
  Primitive shape;
  shape.centre = {x, y};
  shape.angle = angle;
  shape.halfX = shape.halfY = size / 2.0;
  return shape;
}

double secondsOfProcess() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

TEST(Crowd, OfRobotsWithManyPiecesDoesNotHoldUpTheWorld) {
  // 16 robots, each a star of 64 squares, all of which want to the same place.
  Random random(1, 1);
  Physics physics({.cycle = kCycle}, {{-20.0, 20.0, -20.0, 20.0}, {}, {}});
  std::vector<Physics::Body> robots;
  for (int i = 0; i < 16; ++i) {
    std::vector<Primitive> star;
    for (int k = 0; k < 64; ++k)
      star.push_back(box(0.0, 0.0, random.uniform(0.0, 3.0), random.uniform(0.5, 0.52)));
    robots.push_back(physics.add(star, {10.0, Physics::Floor::drives},
                                 {0.8 * (i % 4) - 1.2, 0.8 * (i / 4) - 1.2, 0.0}));
  }
  const double before = secondsOfProcess();
  constexpr int kCycles = 100;
  for (int i = 0; i < kCycles; ++i) {
    for (const Physics::Body robot : robots) {
      const Pose2 pose = physics.pose(robot);
      const double to = std::atan2(-pose.y, -pose.x) - pose.theta;
      physics.want(robot, {0.01 * std::cos(to), 0.01 * std::sin(to), 0.0});
    }
    physics.step(kCycle);
  }
  const double took = (secondsOfProcess() - before) / kCycles;
  RecordProperty("cycle_ms", std::to_string(1000.0 * took));
  EXPECT_LT(took, 0.06) << "seconds a cycle";
}

TEST(Crowd, PiecesWithinOthersCountOnce) {
  const Primitive whole = box(0.0, 0.0, 0.3, 0.5);
  std::vector<Primitive> pieces(256, whole);
  EXPECT_EQ(withoutHidden(pieces).size(), 1u);
  pieces.push_back(box(0.05, 0.05, 0.3, 0.2));
  Primitive round = box(0.0, 0.0, 0.0, 0.3);
  round.shape = Primitive::Shape::ellipse;
  pieces.push_back(round);
  EXPECT_EQ(withoutHidden(pieces).size(), 1u);
  // What sticks out somewhere, or behaves otherwise, stays.
  pieces.push_back(box(0.2, 0.0, 0.0, 0.3));
  pieces.push_back(whole);
  pieces.back().zHigh += 0.1;
  pieces.push_back(box(0.05, 0.05, 0.3, 0.2));
  pieces.back().restitution = 0.9;
  EXPECT_EQ(withoutHidden(pieces).size(), 3u);  // the higher one hides all like the first
}

TEST(Crowd, HiddenPiecesWeighNothing) {
  Physics physics({}, {{-5.0, 5.0, -5.0, 5.0}, {}, {}});
  const Primitive whole = box(0.0, 0.0, 0.0, 0.6);
  const std::vector<Primitive> pieces{whole, box(0.2, 0.2, 0.0, 0.1)};
  const auto one = physics.add({&whole, 1}, {10.0, Physics::Floor::slides}, {});
  const auto other = physics.add(pieces, {10.0, Physics::Floor::slides}, {2.0, 0.0, 0.0});
  EXPECT_NEAR(physics.inertia(one), 10.0 * 0.6 * 0.6 / 6.0, 1e-9);
  EXPECT_EQ(physics.inertia(other), physics.inertia(one));
  EXPECT_EQ(physics.centreOfMass(other).x, 2.0);
}

TEST(Crowd, ContactsThatAreOverCountForNothing) {
  // More often than a body may have contacts at a time, a crate comes to another one and to a wall,
  // and leaves.
  Physics physics({.cycle = kCycle}, {{-5.0, 5.0, -5.0, 5.0}, {box(3.0, 0.0, 0.0, 1.0)}, {}});
  const Primitive crate = box(0.0, 0.0, 0.0, 0.4);
  const auto body = physics.add({&crate, 1}, {1.0, Physics::Floor::slides}, {});
  const auto other = physics.add({&crate, 1}, {1.0, Physics::Floor::slides}, {-3.0, 0.0, 0.0});
  for (int i = 0; i < 300; ++i)
    for (const double x : {0.0, 2.295, 0.0, -2.595}) {
      physics.place(body, {x, 0.0, 0.0});
      physics.step(kCycle);
    }
  const auto drive = [&](double speed) {
    physics.place(body, {0.0, 0.0, 0.0}, {speed, 0.0, 0.0});
    for (int i = 0; i < 100; ++i) physics.step(kCycle);
    return physics.pose(body).x;
  };
  EXPECT_LT(drive(10.0), 2.31);
  const double end = drive(-10.0);
  EXPECT_GT(end, physics.pose(other).x + 0.39);
}

}  // namespace
}  // namespace ortung

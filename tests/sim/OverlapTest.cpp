#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "Physics.hpp"
#include "ortung/base/Angles.hpp"

// Bodies that drive do not get into each other, into walls or into what they push, and what they
// push too weakly stays where it is.
namespace ortung {
namespace {

constexpr double kCycle = 0.01;     ///< [s]
constexpr double kDeepest = 0.003;  ///< that bodies may overlap [m]

Primitive circle(double radius) {
  Primitive shape;
  shape.shape = Primitive::Shape::kEllipse;
  shape.halfX = shape.halfY = radius;
  return shape;
}

Primitive box(double x, double y, double width, double depth) {
  Primitive shape;
  shape.centre = {x, y};
  shape.halfX = width / 2.0;
  shape.halfY = depth / 2.0;
  return shape;
}

Solids room(std::vector<Primitive> primitives = {}) {
  return {{-10.0, 10.0, -10.0, 10.0}, std::move(primitives), {}};
}

double between(const Physics& physics, Physics::Body a, Physics::Body b) {
  const Pose2& p = physics.pose(a);
  const Pose2& q = physics.pose(b);
  return std::hypot(p.x - q.x, p.y - q.y);
}

TEST(Overlap, HeadOnRobotsStayApart) {
  for (const double speed : {0.3, 1.0, 3.0, 5.0}) {
    for (const double aside : {0.0, 0.1, 0.3}) {
      Physics physics({.cycle = kCycle}, room());
      const Primitive shape = circle(0.2);
      const auto one = physics.add({&shape, 1}, {10.0, Physics::Floor::kDrives}, {-2.0, 0.0, 0.0});
      const auto other =
          physics.add({&shape, 1}, {10.0, Physics::Floor::kDrives}, {2.003, aside, 3.14159265});
      double nearest = 10.0;
      for (int i = 0; i < (3.0 / speed + 1.0) / kCycle; ++i) {
        for (const auto body : {one, other}) physics.want(body, {speed * kCycle, 0.0, 0.0});
        physics.step(kCycle);
        nearest = std::min(nearest, between(physics, one, other));
      }
      EXPECT_LT(nearest, 0.42) << "they met";
      EXPECT_GT(nearest, 0.4 - kDeepest) << speed << " m/s, " << aside << " m aside";
    }
  }
}

/// Returns how deep two rectangles that stand alike overlap along the axes of the first [m].
double depthAlong(const Pose2& a, const Primitive& pa, const Pose2& b, const Primitive& pb) {
  const Pose2 seen = inverse(a * Pose2{pa.centre.x, pa.centre.y, 0.0}) *
                     (b * Pose2{pb.centre.x, pb.centre.y, 0.0});
  const double c = std::abs(std::cos(seen.theta));
  const double s = std::abs(std::sin(seen.theta));
  return std::min(pa.halfX + c * pb.halfX + s * pb.halfY - std::abs(seen.x),
                  pa.halfY + s * pb.halfX + c * pb.halfY - std::abs(seen.y));
}

/// How deep two bodies of rectangles overlap, by the axes along which these could be apart [m].
double depthOf(const Pose2& a, const Pose2& b, const std::vector<Primitive>& pieces) {
  double deepest = -1.0;
  for (const Primitive& one : pieces)
    for (const Primitive& other : pieces)
      deepest =
          std::max(deepest, std::min(depthAlong(a, one, b, other), depthAlong(b, other, a, one)));
  return deepest;
}

// Ten robots of three pieces that all want to the ball between them, for a minute: as if all
// contacts were swept, whatever the solver did (9 cycles of 6000 deeper than 3 mm, 4.8 mm at
// worst).
TEST(Overlap, InACrowdIsRareAndShallow) {
  Physics physics({.cycle = kCycle}, room());
  const std::vector<Primitive> pieces{box(-0.04, 0.0, 0.42, 0.5), box(0.205, 0.195, 0.07, 0.11),
                                      box(0.205, -0.195, 0.07, 0.11)};
  std::vector<Physics::Body> robots;
  for (int i = 0; i < 10; ++i) {
    const double angle = 0.2 * std::numbers::pi * i;
    robots.push_back(physics.add(pieces, {30.0, Physics::Floor::kDrives},
                                 {2.0 * std::cos(angle), 2.0 * std::sin(angle), angle + 3.0}));
  }
  const Primitive round = circle(0.11);
  const auto ball = physics.add({&round, 1}, {0.43, Physics::Floor::kRolls}, {});
  int deep = 0;
  double deepest = 0.0;
  constexpr int kCycles = 6000;
  for (int cycle = 0; cycle < kCycles; ++cycle) {
    for (std::size_t i = 0; i < robots.size(); ++i) {
      const Pose2& pose = physics.pose(robots[i]);
      const Pose2& goal = physics.pose(ball);
      const double error = wrapAngle(std::atan2(goal.y - pose.y, goal.x - pose.x) - pose.theta);
      const bool backs = (cycle / 200 + static_cast<int>(i)) % 5 == 0;
      physics.want(robots[i],
                   {(backs ? -1.0 : 2.0 * std::cos(error)) * kCycle, 0.0, 3.0 * error * kCycle});
    }
    physics.step(kCycle);
    double now = 0.0;
    for (std::size_t i = 0; i < robots.size(); ++i)
      for (std::size_t k = i + 1; k < robots.size(); ++k)
        now = std::max(now, depthOf(physics.pose(robots[i]), physics.pose(robots[k]), pieces));
    deep += now > kDeepest ? 1 : 0;
    deepest = std::max(deepest, now);
  }
  RecordProperty("deep", deep);
  RecordProperty("deepest_mm", std::to_string(1e3 * deepest));
  EXPECT_GT(deepest, 0.0005) << "they met";
  EXPECT_LT(deep, 0.005 * kCycles);
  EXPECT_LT(deepest, 0.009);
}

TEST(Overlap, RobotsDoNotGetIntoWallsOrCrates) {
  for (const double speed : {0.5, 3.0, 8.0}) {
    Physics physics({.cycle = kCycle}, room({box(2.0, 0.0, 0.02, 5.0)}));
    const Primitive shape = circle(0.2);
    const Primitive crate = box(0.0, 0.0, 0.4, 0.4);
    const auto robot = physics.add({&shape, 1}, {10.0, Physics::Floor::kDrives}, {-6.0, 0.0, 0.0});
    const auto pushed = physics.add({&crate, 1}, {5.0, Physics::Floor::kSlides}, {1.0, 0.0, 0.0});
    double nearest = 10.0;
    double farthest = -10.0;
    for (int i = 0; i < 3000; ++i) {
      physics.want(robot, {speed * kCycle, 0.0, 0.0});
      physics.step(kCycle);
      nearest = std::min(nearest, physics.pose(pushed).x - physics.pose(robot).x);
      farthest = std::max(farthest, physics.pose(pushed).x);
    }
    EXPECT_GT(nearest, 0.4 - kDeepest) << speed;
    EXPECT_LT(farthest, 1.79 + kDeepest) << speed;
    EXPECT_GT(farthest, 1.7) << speed << ": it was pushed to the wall";
  }
}

TEST(Overlap, AnArmOpensOnlyWhereItHasRoom) {
  Physics physics({.cycle = kCycle}, room({box(0.45, 0.0, 0.1, 5.0)}));  // a wall at 0.4 m
  const std::vector<Primitive> closed{circle(0.2)};
  const std::vector<Primitive> arm{box(0.35, 0.0, 0.3, 0.1)};  // to 0.5 m
  std::vector<Primitive> open = closed;
  open.push_back(arm.front());
  const auto robot = physics.add(closed, {10.0, Physics::Floor::kDrives}, {});
  EXPECT_FALSE(physics.reshape(robot, open, arm));
  for (int i = 0; i < 50; ++i) physics.step(kCycle);
  EXPECT_EQ(physics.pose(robot).x, 0.0);
  EXPECT_TRUE(physics.isFree(closed, physics.pose(robot), robot));
  // It stands there with its old shape.
  const Primitive small = circle(0.05);
  EXPECT_TRUE(physics.isFree({&small, 1}, {0.3, 0.0, 0.0}, Physics::kNobody));
  physics.place(robot, {-0.2, 0.0, 0.0});
  EXPECT_TRUE(physics.reshape(robot, open, arm));
  EXPECT_FALSE(physics.isFree({&small, 1}, {0.2, 0.0, 0.0}, Physics::kNobody));
  // Open, it drives up to the wall and no farther, and is not thrown back.
  double farthest = -1.0;
  for (int i = 0; i < 300; ++i) {
    physics.want(robot, {0.5 * kCycle, 0.0, 0.0});
    physics.step(kCycle);
    farthest = std::max(farthest, physics.pose(robot).x);
  }
  EXPECT_NEAR(farthest, -0.1, kDeepest);
  EXPECT_NEAR(physics.pose(robot).x, -0.1, kDeepest);
}

TEST(Overlap, AnArmDoesNotOpenIntoAnotherRobot) {
  Physics physics({.cycle = kCycle}, room());
  const std::vector<Primitive> closed{circle(0.2)};
  const std::vector<Primitive> arm{box(0.35, 0.0, 0.3, 0.1)};
  std::vector<Primitive> open = closed;
  open.push_back(arm.front());
  const auto robot = physics.add(closed, {10.0, Physics::Floor::kDrives}, {});
  const auto other = physics.add(closed, {10.0, Physics::Floor::kDrives}, {0.6, 0.0, 0.0});
  EXPECT_FALSE(physics.reshape(robot, open, arm));
  physics.place(other, {0.72, 0.0, 0.0});
  EXPECT_TRUE(physics.reshape(robot, open, arm));
}

TEST(Overlap, AnArmPushesABallAsideAtOnce) {
  Physics physics({.cycle = kCycle, .rollingResistance = 0.0}, room());
  const std::vector<Primitive> closed{circle(0.2)};
  const std::vector<Primitive> arm{box(0.3, 0.0, 0.2, 0.3)};  // its front: 0.4 m
  std::vector<Primitive> open = closed;
  open.push_back(arm.front());
  const Primitive ball = circle(0.11);
  const auto robot = physics.add(closed, {10.0, Physics::Floor::kDrives}, {});
  const auto pushed = physics.add({&ball, 1}, {0.43, Physics::Floor::kRolls}, {0.32, 0.0, 0.0});
  EXPECT_TRUE(physics.reshape(robot, open, arm));
  EXPECT_NEAR(physics.pose(pushed).x, 0.51, 0.002);  // the shortest way
  EXPECT_NEAR(physics.pose(pushed).y, 0.0, 1e-6);
  for (int i = 0; i < 50; ++i) physics.step(kCycle);
  EXPECT_NEAR(physics.pose(pushed).x, 0.51, 0.002);  // nor does it get a speed out of nothing
}

TEST(Overlap, AnArmDoesNotPushABallThroughAWall) {
  // Between the arm and a thin wall there is no room for the ball; beyond the wall there is.
  Physics physics({.cycle = kCycle}, room({box(0.45, 0.0, 0.01, 8.0), box(0.2, 0.7, 0.6, 0.9),
                                           box(0.2, -0.7, 0.6, 0.9)}));
  const std::vector<Primitive> closed{circle(0.1)};
  const std::vector<Primitive> arm{box(0.2, 0.0, 0.2, 0.3)};
  std::vector<Primitive> open = closed;
  open.push_back(arm.front());
  const Primitive ball = circle(0.11);
  const auto robot = physics.add(closed, {10.0, Physics::Floor::kDrives}, {});
  const auto pushed = physics.add({&ball, 1}, {0.43, Physics::Floor::kRolls}, {0.33, 0.0, 0.0});
  EXPECT_FALSE(physics.reshape(robot, open, arm));
  EXPECT_EQ(physics.pose(pushed).x, 0.33);
  for (int i = 0; i < 50; ++i) physics.step(kCycle);
  EXPECT_LT(physics.pose(pushed).x, 0.445);
}

// All things give way, or none of them moves: whichever is looked at first.
TEST(Overlap, AnArmThatOneBallHoldsUpLeavesTheOtherWhereItIs) {
  const std::vector<Primitive> closed{circle(0.1)};
  const Primitive ball = circle(0.11);
  for (const double first : {0.2, -0.2}) {
    // In front there is no room between the arm and the wall, behind there is.
    Physics physics({.cycle = kCycle}, room({box(0.45, 0.0, 0.01, 8.0), box(0.2, 0.7, 0.6, 0.9),
                                             box(0.2, -0.7, 0.6, 0.9)}));
    const std::vector<Primitive> arms{box(first, 0.0, 0.2, 0.3), box(-first, 0.0, 0.2, 0.3)};
    std::vector<Primitive> open = closed;
    open.insert(open.end(), arms.begin(), arms.end());
    const auto robot = physics.add(closed, {10.0, Physics::Floor::kDrives}, {});
    const auto held = physics.add({&ball, 1}, {0.43, Physics::Floor::kRolls}, {0.33, 0.0, 0.0});
    const auto loose = physics.add({&ball, 1}, {0.43, Physics::Floor::kRolls}, {-0.33, 0.0, 0.0});
    EXPECT_FALSE(physics.reshape(robot, open, arms));
    EXPECT_FALSE(physics.isFree({&ball, 1}, {-0.33, 0.0, 0.0}, robot));
    EXPECT_TRUE(physics.isFree({&ball, 1}, {-0.56, 0.0, 0.0}, robot));
    for (int i = 0; i < 5; ++i) physics.step(kCycle);
    EXPECT_NEAR(physics.pose(held).x, 0.33, 1e-6);
    EXPECT_NEAR(physics.pose(loose).x, -0.33, 1e-6);
  }
}

TEST(Push, TooWeakMovesNothing) {
  // A robot of 10 kg pushes with at most 0.7 x 9.81 x 10 N; the crate holds with up to mu m g.
  for (const double mass : {10.5, 15.0, 40.0, 200.0}) {
    Physics physics({.cycle = kCycle, .restitution = 0.0}, room());
    const Primitive shape = circle(0.2);
    const Primitive crate = box(0.0, 0.0, 0.4, 0.4);
    const auto robot = physics.add({&shape, 1}, {10.0, Physics::Floor::kDrives}, {-0.41, 0.0, 0.0});
    const auto pushed = physics.add({&crate, 1}, {mass, Physics::Floor::kSlides}, {});
    const auto push = [&](int cycles) {
      const double from = physics.pose(pushed).x;
      for (int i = 0; i < cycles; ++i) {
        physics.want(robot, {0.1 * kCycle, 0.0, 0.0});
        physics.step(kCycle);
      }
      return physics.pose(pushed).x - from;
    };
    push(100);                            // the impact may move it
    EXPECT_LT(push(2000), 1e-3) << mass;  // 20 s
  }
}

TEST(Push, StrongEnoughMovesAsItMust) {
  // Together they accelerate with mu g (m1 - m2) / (m1 + m2).
  const double mass = 5.0;
  Physics physics({.cycle = kCycle, .restitution = 0.0, .floorFriction = 0.5}, room());
  const Primitive shape = circle(0.2);
  const Primitive crate = box(0.0, 0.0, 0.4, 0.4);
  const auto robot = physics.add({&shape, 1}, {10.0, Physics::Floor::kDrives}, {-0.401, 0.0, 0.0});
  const auto pushed = physics.add({&crate, 1}, {mass, Physics::Floor::kSlides}, {});
  for (int i = 0; i < 50; ++i) {
    physics.want(robot, {10.0 * kCycle, 0.0, 0.0});
    physics.step(kCycle);
  }
  const double a = 0.5 * kGravity * (10.0 - mass) / (10.0 + mass);
  EXPECT_NEAR(physics.velocity(pushed).x, 0.5 * a, 0.1 * a);
}

TEST(Push, AStandingRobotIsNotCreptAway) {
  for (const double mass : {12.0, 30.0}) {
    Physics physics({.cycle = kCycle, .restitution = 0.0}, room());
    const Primitive shape = circle(0.2);
    const auto robot = physics.add({&shape, 1}, {10.0, Physics::Floor::kDrives}, {-0.41, 0.0, 0.0});
    const auto stands = physics.add({&shape, 1}, {mass, Physics::Floor::kDrives}, {});
    double first = 0.0;
    for (int i = 0; i < 2100; ++i) {
      physics.want(robot, {0.1 * kCycle, 0.0, 0.0});
      physics.step(kCycle);
      if (i == 100) first = physics.pose(stands).x;  // the impact may move it
    }
    EXPECT_LT(physics.pose(stands).x - first, 1e-3) << mass;
  }
}

}  // namespace
}  // namespace ortung

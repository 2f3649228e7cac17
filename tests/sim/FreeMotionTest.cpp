#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "Physics.hpp"

// Bodies that nothing touches, friction between two that touch, and long cycles.
namespace ortung {
namespace {

constexpr double kCycle = 0.01;  ///< [s]

Primitive boxAt(double x, double y, double halfX, double halfY) {
  Primitive shape;
  shape.centre = {x, y};
  shape.halfX = halfX;
  shape.halfY = halfY;
  return shape;
}

Primitive circle(double radius) {
  Primitive shape;
  shape.shape = Primitive::Shape::kEllipse;
  shape.halfX = shape.halfY = radius;
  return shape;
}

/// A body of two pieces whose centre of mass lies off its origin, in a field without friction.
struct Lopsided {
  /// @param neighbour something stands so near that the engine has to look at each step
  explicit Lopsided(bool neighbour)
      : physics({.cycle = kCycle, .floorFriction = 0.0}, room(neighbour)) {
    const std::vector<Primitive> pieces{boxAt(0.3, 0.1, 0.2, 0.1), boxAt(0.5, 0.1, 0.05, 0.3)};
    body = physics.add(pieces, {3.0, Physics::Floor::kSlides}, {0.0, 0.0, 0.4});
    physics.place(body, {0.0, 0.0, 0.4}, {0.2, -0.1, 1.5});
  }
  static Solids room(bool neighbour) {
    Solids solids{{-20.0, 20.0, -20.0, 20.0}, {}, {}};
    if (neighbour) solids.primitives.push_back(boxAt(1.6, -1.0, 0.2, 0.2));
    return solids;
  }
  Physics physics;
  Physics::Body body = 0;
};

// The engine looks at each step, since there is a wall 2 cm beside the way.
TEST(FreeMotion, ADrivingBodyGoesAsItWantsUntilSomethingIsInItsWay) {
  for (int direction = 0; direction < 16; ++direction) {
    const double angle = 2.0 * std::numbers::pi * direction / 16;
    const double c = std::cos(angle);
    const double s = std::sin(angle);
    const auto wallAt = [&](double along, double aside, double halfAlong, double halfAside) {
      Primitive wall = boxAt(c * along - s * aside, s * along + c * aside, halfAlong, halfAside);
      wall.angle = angle;
      return wall;
    };
    Physics physics({.cycle = kCycle}, {{-20.0, 20.0, -20.0, 20.0},
                                        {wallAt(0.0, 0.32, 2.0, 0.1), wallAt(0.6, 0.0, 0.1, 0.2)},
                                        {}});
    const Primitive shape = circle(0.2);
    const auto robot = physics.add({&shape, 1}, {10.0, Physics::Floor::kDrives}, {});
    double way = 0.0;
    double speed = 0.0;
    for (int i = 0; i < 40; ++i) {  // 0.16 m, up to 0.8 m/s
      speed += 2.0 * kCycle;
      way += speed * kCycle;
      physics.want(robot, {c * speed * kCycle, s * speed * kCycle, 0.0});
      physics.step(kCycle);
      ASSERT_FALSE(physics.wasDisturbed(robot)) << direction << " " << i;
      ASSERT_NEAR(physics.pose(robot).x, c * way, 1e-12);
      ASSERT_NEAR(physics.pose(robot).y, s * way, 1e-12);
    }
    int disturbed = 0;
    for (int i = 0; i < 40; ++i) {  // 0.32 m more, of which it gets half
      physics.want(robot, {c * speed * kCycle, s * speed * kCycle, 0.0});
      physics.step(kCycle);
      disturbed += physics.wasDisturbed(robot) ? 1 : 0;
    }
    EXPECT_GT(disturbed, 5) << direction;
    EXPECT_LT(c * physics.pose(robot).x + s * physics.pose(robot).y, 0.31) << direction;
  }
}

// About its centroid a right triangle has the moment m (a^2 + b^2) / 18, a and b being its legs.
TEST(FreeMotion, ATriangleIsAsHardToTurnAsItsShapeSays) {
  Physics physics({.cycle = kCycle}, {{-5.0, 5.0, -5.0, 5.0}, {}, {}});
  Primitive wedge;
  wedge.shape = Primitive::Shape::kTriangle;
  wedge.corners = {{{-0.2, -0.3}, {0.4, -0.3}, {-0.2, 0.6}}};
  const auto one = physics.add({&wedge, 1}, {10.0, Physics::Floor::kSlides}, {});
  EXPECT_NEAR(physics.inertia(one), 10.0 * (0.6 * 0.6 + 0.9 * 0.9) / 18.0, 1e-9);
  // Two of them, back to back, are a rectangle: m (a^2 + b^2) / 12.
  Primitive other = wedge;
  other.corners = {{{0.4, 0.6}, {-0.2, 0.6}, {0.4, -0.3}}};
  other.centre = {0.2, 0.3};
  const std::vector<Primitive> pieces{wedge, other};
  const auto both = physics.add(pieces, {10.0, Physics::Floor::kSlides}, {2.0, 0.0, 0.0});
  EXPECT_NEAR(physics.inertia(both), 10.0 * (0.6 * 0.6 + 0.9 * 0.9) / 12.0, 1e-9);
}

TEST(FreeMotion, TheCentreOfMassGoesStraight) {
  for (const bool neighbour : {false, true}) {
    Lopsided thing(neighbour);
    const Point2 from = thing.physics.centreOfMass(thing.body);
    const Pose2 start = thing.physics.pose(thing.body);
    // Velocity of the centre of mass: that of the origin and w x r.
    const double vx = 0.2 - 1.5 * (from.y - start.y);
    const double vy = -0.1 + 1.5 * (from.x - start.x);
    for (int i = 1; i <= 100; ++i) {
      thing.physics.step(kCycle);
      const Point2 now = thing.physics.centreOfMass(thing.body);
      ASSERT_NEAR(now.x, from.x + vx * i * kCycle, 1e-4) << neighbour;
      ASSERT_NEAR(now.y, from.y + vy * i * kCycle, 1e-4) << neighbour;
    }
    EXPECT_NEAR(thing.physics.pose(thing.body).theta, 0.4 + 1.5, 1e-4);
  }
}

TEST(FreeMotion, TheVelocityIsThatOfTheOrigin) {
  for (const bool neighbour : {false, true}) {
    Lopsided thing(neighbour);
    for (int i = 0; i < 100; ++i) {
      const Pose2 before = thing.physics.pose(thing.body);
      const Twist first = thing.physics.velocity(thing.body);
      thing.physics.step(kCycle);
      const Pose2 after = thing.physics.pose(thing.body);
      const Twist second = thing.physics.velocity(thing.body);
      // The mean of a step's ends is the step's velocity but for its curvature (1e-4).
      ASSERT_NEAR((after.x - before.x) / kCycle, 0.5 * (first.x + second.x), 1e-3) << neighbour;
      ASSERT_NEAR((after.y - before.y) / kCycle, 0.5 * (first.y + second.y), 1e-3) << neighbour;
    }
  }
}

// Between two walls that it does not touch the engine has to look at each step. Nothing keeps a
// body there from going where it wants, to the last bit, until there is something in its way.
TEST(FreeMotion, ADrivingBodyThatNothingTouchesGoesWhereItWants) {
  for (const double direction : {0.6, 2.2, -0.6, -2.2}) {
    const double c = std::cos(direction);
    const double s = std::sin(direction);
    Solids corridor{{-20.0, 20.0, -20.0, 20.0}, {}, {}};
    for (const double side : {-0.4, 0.4}) {
      Primitive wall = boxAt(-side * s, side * c, 10.0, 0.1);
      wall.angle = direction;
      corridor.primitives.push_back(wall);
    }
    for (const bool isBlocked : {false, true}) {
      Physics physics({.cycle = kCycle}, corridor);
      const Primitive shape = circle(0.25);
      const Pose2 start{-c, -s, 0.3};
      const auto body = physics.add({&shape, 1}, {10.0, Physics::Floor::kDrives}, start);
      physics.place(body, start, {0.5 * c, 0.5 * s, 1.0});
      const Primitive heavy = circle(0.1);
      if (isBlocked)
        physics.add({&heavy, 1}, {50.0, Physics::Floor::kSlides}, {-0.4 * c, -0.4 * s, 0.0});
      bool wasDisturbed = false;
      for (int i = 1; i <= 100; ++i) {
        const double way = 0.5 * i * kCycle;
        const Pose2 wanted{start.x + way * c, start.y + way * s, start.theta + i * kCycle};
        const Pose2 before = physics.pose(body);
        const Pose2 change = inverse(before) * wanted;
        physics.want(body, change);
        physics.step(kCycle);
        wasDisturbed = wasDisturbed || physics.wasDisturbed(body);
        if (isBlocked) continue;
        const Pose2 planned = before * change;
        ASSERT_EQ(physics.pose(body).x, planned.x) << direction << " " << i;
        ASSERT_EQ(physics.pose(body).y, planned.y) << direction << " " << i;
        ASSERT_EQ(physics.pose(body).theta, planned.theta) << direction << " " << i;
      }
      EXPECT_EQ(wasDisturbed, isBlocked) << direction;
    }
  }
}

TEST(Friction, OfTwoBodiesIsTheGeometricMeanOfTheirOwn) {
  // The spinning first hits the second; the impulse across is mu times that along, since they slip.
  struct Case {
    std::optional<double> first, second;
    double mu;
  };
  for (const Case& c :
       {Case{{}, {}, 0.2}, Case{0.04, 0.25, 0.1}, Case{0.05, {}, 0.1}, Case{0.0, 1.0, 0.0}}) {
    Physics physics({.cycle = kCycle, .friction = 0.2, .restitution = 0.5, .floorFriction = 0.0},
                    {{-20.0, 20.0, -20.0, 20.0}, {}, {}});
    Primitive one = circle(0.2);
    Primitive other = circle(0.2);
    one.friction = c.first;
    other.friction = c.second;
    const auto a = physics.add({&one, 1}, {5.0, Physics::Floor::kSlides}, {-0.6, 0.0, 0.0});
    physics.add({&other, 1}, {5.0, Physics::Floor::kSlides}, {});
    physics.place(a, {-0.6, 0.0, 0.0}, {1.0, 0.0, 30.0});  // its rim: 6 m/s across
    for (int i = 0; i < 40; ++i) physics.step(kCycle);
    const Twist v = physics.velocity(a);
    EXPECT_NEAR(std::abs(v.y), c.mu * (1.0 - v.x), 0.01 * (1.0 - v.x)) << c.mu;
  }
}

TEST(LongCycles, AreDoneInParts) {
  // Euler's steps are off by half a step of the first velocity: 0.3 m in steps of 0.2 s, 0.03 m in
  // those of 0.02 s that are made of them.
  for (const double cycle : {0.01, 0.2, 1.0}) {
    Physics physics({.cycle = cycle, .floorFriction = 0.3}, {{-50.0, 50.0, -50.0, 50.0}, {}, {}});
    const Primitive shape = circle(0.11);
    const auto body = physics.add({&shape, 1}, {1.0, Physics::Floor::kSlides}, {});
    physics.place(body, {}, {3.0, 0.0, 0.0});
    for (double t = 0.0; t < 3.0; t += cycle) physics.step(cycle);
    EXPECT_NEAR(physics.pose(body).x, 9.0 / (2.0 * 0.3 * kGravity), 0.04) << cycle;
  }
}

}  // namespace
}  // namespace ortung

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "Physics.hpp"

// Impacts of two free bodies against eqs. (1) to (5) of the paper.
namespace ortung {
namespace {

constexpr double kCycle = 0.01;  ///< [s]

Primitive shaped(Primitive::Shape shape, double halfX, double halfY) {
  Primitive primitive;
  primitive.shape = shape;
  primitive.halfX = halfX;
  primitive.halfY = halfY;
  return primitive;
}

/// What one body has at one moment, seen from a fixed point.
struct Motion {
  Point2 momentum;               ///< [kg m/s]
  double angularMomentum = 0.0;  ///< around the field's origin [kg m^2/s]
  double energy = 0.0;           ///< [J]
};

struct Approach {
  Primitive first = shaped(Primitive::Shape::kEllipse, 0.25, 0.25);
  Primitive second = shaped(Primitive::Shape::kEllipse, 0.25, 0.25);
  double firstMass = 10.0, secondMass = 10.0;  ///< [kg]
  double restitution = 0.5;
  double friction = 0.3;
  double speed = 1.0;    ///< of the approach [m/s]
  double offset = 0.15;  ///< across the approach, which makes the impact oblique [m]
  Twist firstExtra;      ///< the velocity that the first has besides
};

/// Two bodies on a floor without friction, flying at each other.
class TwoBodies {
 public:
  explicit TwoBodies(const Approach& setup)
      : physics_({.cycle = kCycle,
                  .friction = setup.friction,
                  .restitution = setup.restitution,
                  .floorFriction = 0.0,
                  .rollingResistance = 0.0},
                 {{-50.0, 50.0, -50.0, 50.0}, {}, {}}) {
    const double gap = 0.02 + setup.speed * 0.005;  // [m]
    const double distance = gap + reachOf(setup.first) + reachOf(setup.second);
    first_ = physics_.add({&setup.first, 1}, {setup.firstMass, Physics::Floor::kSlides}, {});
    second_ = physics_.add({&setup.second, 1}, {setup.secondMass, Physics::Floor::kSlides}, {});
    physics_.place(first_, {-distance, 0.0, 0.3},
                   {setup.speed + setup.firstExtra.x, setup.firstExtra.y, setup.firstExtra.theta});
    physics_.place(second_, {0.0, setup.offset, -0.2}, {setup.firstExtra.x, setup.firstExtra.y, 0});
    firstBefore_ = physics_.velocity(first_);
    secondBefore_ = physics_.velocity(second_);
    before_ = total();
  }

  /// Steps until velocities change; false if that does not happen within @p seconds.
  bool run(double seconds) {
    for (int i = 0; i < seconds / kCycle; ++i) {
      firstPose_ = physics_.pose(first_);
      secondPose_ = physics_.pose(second_);
      physics_.step(kCycle);
      if (physics_.velocity(first_).x != firstBefore_.x) return true;
    }
    return false;
  }

  Motion total() const {
    Motion sum;
    for (const Physics::Body body : {first_, second_}) {
      const double m = physics_.mass(body);
      const Twist v = physics_.velocity(body);
      const Point2 c = physics_.centreOfMass(body);
      sum.momentum.x += m * v.x;
      sum.momentum.y += m * v.y;
      sum.angularMomentum += physics_.inertia(body) * v.theta + m * (c.x * v.y - c.y * v.x);
      sum.energy +=
          0.5 * (m * (v.x * v.x + v.y * v.y) + physics_.inertia(body) * v.theta * v.theta);
    }
    return sum;
  }
  const Motion& before() const { return before_; }

  /// Direction of the impulse that the first body got: (along, across) of the line of centres is
  /// the line of impact for two circles.
  Point2 impulse() const {
    const Twist v = physics_.velocity(first_);
    return {physics_.mass(first_) * (v.x - firstBefore_.x),
            physics_.mass(first_) * (v.y - firstBefore_.y)};
  }
  /// Relative velocity of the surfaces at a point, now or before the impact.
  Point2 relative(const Point2& point, bool isAfter) const {
    const Twist a = isAfter ? physics_.velocity(first_) : firstBefore_;
    const Twist b = isAfter ? physics_.velocity(second_) : secondBefore_;
    const Point2 ca = physics_.centreOfMass(first_);
    const Point2 cb = physics_.centreOfMass(second_);
    return {a.x - a.theta * (point.y - ca.y) - b.x + b.theta * (point.y - cb.y),
            a.y + a.theta * (point.x - ca.x) - b.y - b.theta * (point.x - cb.x)};
  }
  /// Angular momentum around its own centre that a body got in the impact [kg m^2/s].
  double spinGained(int body) const {
    const Physics::Body one = body == 0 ? first_ : second_;
    const double before = body == 0 ? firstBefore_.theta : secondBefore_.theta;
    return physics_.inertia(one) * (physics_.velocity(one).theta - before);
  }
  /// Relative velocity of the centres, now or before the impact.
  Point2 ofCentres(bool isAfter) const {
    const Twist a = isAfter ? physics_.velocity(first_) : firstBefore_;
    const Twist b = isAfter ? physics_.velocity(second_) : secondBefore_;
    return {a.x - b.x, a.y - b.y};
  }
  /// Line of impact of two circles: from the first to the second, of length 1.
  Point2 normal() const {
    const Point2 a = physics_.centreOfMass(first_);
    const Point2 b = physics_.centreOfMass(second_);
    const double away = std::hypot(b.x - a.x, b.y - a.y);
    return {(b.x - a.x) / away, (b.y - a.y) / away};
  }
  /// Where two circles touch.
  Point2 contact(const Approach& setup) const {
    const Point2 a = physics_.centreOfMass(first_);
    const Point2 n = normal();
    return {a.x + setup.first.halfX * n.x, a.y + setup.first.halfX * n.y};
  }
  Physics& physics() { return physics_; }

 private:
  Physics physics_;
  Physics::Body first_ = 0, second_ = 0;
  Pose2 firstPose_, secondPose_;
  Twist firstBefore_, secondBefore_;
  Motion before_;
};

std::string describe(const Approach& s) {
  return "masses " + std::to_string(s.firstMass) + " " + std::to_string(s.secondMass) + ", e " +
         std::to_string(s.restitution) + ", friction " + std::to_string(s.friction) + ", speed " +
         std::to_string(s.speed) + ", offset " + std::to_string(s.offset);
}

double dot(const Point2& a, const Point2& b) { return a.x * b.x + a.y * b.y; }
double across(const Point2& a, const Point2& n) { return a.y * n.x - a.x * n.y; }

/// Calls test(setup) for a grid of impacts.
template <class Test>
void forGrid(const Test& test) {
  Approach setup;
  for (const double speed : {0.001, 0.05, 0.7, 3.0, 8.0})
    for (const double mass : {0.43, 10.0, 80.0})
      for (const double restitution : {0.0, 0.3, 0.8, 1.0})
        for (const double offset : {0.0, 0.1, 0.3}) {
          setup.speed = speed;
          setup.secondMass = mass;
          setup.restitution = restitution;
          setup.offset = offset;
          setup.firstExtra = {0.0, 0.1 * speed, speed};
          test(setup);
        }
}

/// Equations (1) and (2), and the sum of (3) and (4). The engine counts in single precision: 2e-6
/// of the momentum that there is. It then pushes apart what overlaps, by up to 0.015 m along the
/// line of impact, which changes the angular momentum around a fixed point by as much times the
/// momentum that goes across.
void expectConserved(const TwoBodies& impact, const Approach& setup) {
  const Motion before = impact.before();
  const Motion after = impact.total();
  const double scale = (setup.firstMass + setup.secondMass) * setup.speed;
  const double reduced =
      setup.firstMass * setup.secondMass / (setup.firstMass + setup.secondMass);  // [kg]
  EXPECT_NEAR(after.momentum.x, before.momentum.x, 2e-6 * scale) << describe(setup);
  EXPECT_NEAR(after.momentum.y, before.momentum.y, 2e-6 * scale) << describe(setup);
  EXPECT_NEAR(after.angularMomentum, before.angularMomentum,
              1e-5 * scale + 0.015 * reduced * setup.speed)
      << describe(setup);
}

/// Equations (3), (4) and (5) for two circles, whose contact lies R_i n from their centres whatever
/// n is: I_i (Omega_i - omega_i) = R_i T with the same impulse T across for both; n is where the
/// whole impulse J points but for T; and along n Newton's hypothesis holds.
/// @param tolerance of the last: with friction, a little overlap makes the levers a little shorter
void expectCirclesObey(const TwoBodies& impact, const Approach& setup, double tolerance) {
  const double first = impact.spinGained(0) / setup.first.halfX;    // T [N s]
  const double second = impact.spinGained(1) / setup.second.halfX;  // T
  const Point2 impulse = impact.impulse();
  const double size = std::hypot(impulse.x, impulse.y);
  EXPECT_NEAR(first, second, 1e-4 * size) << describe(setup);
  const double turned = std::asin(std::clamp(first / size, -1.0, 1.0));
  const double direction = std::atan2(impulse.y, impulse.x) + turned;
  const Point2 n{std::cos(direction), std::sin(direction)};
  EXPECT_NEAR(dot(impact.ofCentres(true), n), -setup.restitution * dot(impact.ofCentres(false), n),
              tolerance * setup.speed)
      << describe(setup);
}

TEST(Impact, OfTwoCirclesObeysTheEquations) {
  forGrid([](const Approach& setup) {
    TwoBodies impact(setup);
    ASSERT_TRUE(impact.run(60.0 * std::max(1.0, 0.05 / setup.speed))) << describe(setup);
    expectConserved(impact, setup);
    expectCirclesObey(impact, setup, 5e-3);
    Approach smooth = setup;
    smooth.friction = 0.0;
    TwoBodies withoutFriction(smooth);
    ASSERT_TRUE(withoutFriction.run(60.0 * std::max(1.0, 0.05 / setup.speed)));
    expectCirclesObey(withoutFriction, smooth, 2e-5);
  });
}

TEST(Impact, OfRectanglesAndEllipsesKeepsMomenta) {
  forGrid([](Approach setup) {
    if (setup.speed > 3.0) return;
    setup.first = shaped(Primitive::Shape::kRectangle, 0.25, 0.1);
    setup.second = shaped(Primitive::Shape::kEllipse, 0.3, 0.15);
    setup.friction = 0.0;
    TwoBodies impact(setup);
    if (!impact.run(60.0 * std::max(1.0, 0.05 / setup.speed))) return;  // they may miss each other
    expectConserved(impact, setup);
    // No energy comes from nowhere. (With friction it may, by Newton's hypothesis itself.)
    EXPECT_LE(impact.total().energy, impact.before().energy * (1.0 + 1e-5)) << describe(setup);
  });
}

TEST(Impact, OfFullElasticityKeepsTheEnergy) {
  for (const double speed : {0.001, 0.1, 2.0}) {
    Approach setup;
    setup.friction = 0.0;
    setup.restitution = 1.0;
    setup.speed = speed;
    setup.secondMass = 3.0;
    TwoBodies impact(setup);
    ASSERT_TRUE(impact.run(100.0));
    EXPECT_NEAR(impact.total().energy, impact.before().energy, 1e-5 * impact.before().energy);
  }
}

TEST(Impact, AcrossLiesBetweenNoFrictionAndSticking) {
  // The surfaces of the first body run across the second's; friction brakes that, the more the
  // larger it is, until they stick. Sticking: no relative velocity across is left.
  double last = 0.0;
  for (const double friction : {0.0, 0.02, 0.05, 0.1, 0.2, 0.5, 1.0, 3.0}) {
    Approach setup;
    setup.offset = 0.0;
    setup.restitution = 0.5;
    setup.friction = friction;
    setup.firstExtra.theta = 2.0;  // 0.5 m/s at its rim
    TwoBodies impact(setup);
    ASSERT_TRUE(impact.run(5.0));
    const Point2 n = impact.normal();
    const Point2 contact = impact.contact(setup);
    const double before = across(impact.relative(contact, false), n);
    const double after = across(impact.relative(contact, true), n);
    const Point2 impulse = impact.impulse();
    if (friction == 0.0) {
      EXPECT_NEAR(after, before, 1e-4);
      EXPECT_NEAR(across(impulse, n), 0.0, 1e-3);
      last = std::abs(after);
      continue;
    }
    EXPECT_GE(before * after, -1e-4) << friction;         // never beyond sticking
    EXPECT_LE(std::abs(after), last + 1e-6) << friction;  // never less for more friction
    EXPECT_LE(std::abs(across(impulse, n)),               // never beyond Coulomb's cone
              friction * std::abs(dot(impulse, n)) * 1.001 + 1e-3)
        << friction;
    last = std::abs(after);
  }
  EXPECT_NEAR(last, 0.0, 0.01);  // of 0.5 m/s; the overlap again
}

TEST(Impact, OfABallWithAThinWallNeverGoesThrough) {
  for (const double cycle : {0.001, 0.01, 0.1, 1.0}) {  // the last is the coarsest permitted
    for (const double angle : {0.0, 0.3, 1.0}) {
      Solids solids;
      solids.bounds = {-5.0, 5.0, -30.0, 30.0};
      Primitive wall = shaped(Primitive::Shape::kRectangle, 0.01, 30.0);
      wall.centre.x = 2.0;
      solids.primitives.push_back(wall);
      Physics physics({.cycle = cycle, .rollingResistance = 0.0}, solids);
      const Primitive ball = shaped(Primitive::Shape::kEllipse, 0.11, 0.11);
      const Physics::Body body = physics.add({&ball, 1}, {0.43, Physics::Floor::kRolls}, {});
      physics.place(body, {0.0, -10.0 * std::sin(angle), 0.0},
                    {12.0 * std::cos(angle), 12.0 * std::sin(angle), 0.0});
      double farthest = 0.0;
      for (double t = 0.0; t < 1.5; t += cycle) {
        physics.step(cycle);
        farthest = std::max(farthest, physics.pose(body).x);
      }
      EXPECT_LT(farthest, 1.99 - 0.11 + 0.03) << cycle << " " << angle;
    }
  }
}

TEST(Impact, NothingGoesThroughOutlinesOrFences) {
  Solids solids;
  solids.bounds = {-3.0, 3.0, -3.0, 3.0};
  solids.walls.push_back({{1.0, -3.0}, {1.0, 3.0}, 0.0, 1.0});
  Physics physics({.restitution = 0.9, .floorFriction = 0.0, .rollingResistance = 0.0}, solids);
  const Primitive ball = shaped(Primitive::Shape::kEllipse, 0.11, 0.11);
  const Primitive crate = shaped(Primitive::Shape::kRectangle, 0.2, 0.15);
  const Physics::Body one = physics.add({&ball, 1}, {0.43, Physics::Floor::kRolls}, {});
  const Physics::Body other =
      physics.add({&crate, 1}, {5.0, Physics::Floor::kSlides}, {-2.0, 1.0, 0.0});
  physics.place(one, {0.0, 0.0, 0.0}, {12.0, 5.0, 0.0});
  physics.place(other, {-2.0, 1.0, 0.0}, {6.0, -2.0, 3.0});
  for (int i = 0; i < 5000; ++i) {
    physics.step(kCycle);
    for (const Physics::Body body : {one, other}) {
      ASSERT_LT(physics.pose(body).x, 1.0) << i;
      ASSERT_GT(physics.pose(body).x, -3.0) << i;
      ASSERT_LT(std::abs(physics.pose(body).y), 3.0) << i;
    }
  }
}

TEST(Impact, HappensOnlyWhereHeightsOverlap) {
  Solids solids;
  solids.bounds = {-5.0, 5.0, -5.0, 5.0};
  Primitive bar = shaped(Primitive::Shape::kRectangle, 0.05, 3.0);
  bar.centre.x = 1.0;
  bar.zLow = 1.0;
  bar.zHigh = 1.1;
  solids.primitives.push_back(bar);
  Physics physics({.rollingResistance = 0.0}, solids);
  Primitive ball = shaped(Primitive::Shape::kEllipse, 0.11, 0.11);
  ball.zHigh = 0.22;
  const Physics::Body body = physics.add({&ball, 1}, {0.43, Physics::Floor::kRolls}, {});
  physics.place(body, {}, {2.0, 0.0, 0.0});
  for (int i = 0; i < 100; ++i) physics.step(kCycle);
  EXPECT_NEAR(physics.pose(body).x, 2.0, 1e-3);
}

TEST(Floor, BrakesWhatRollsLittleAndWhatSlidesMuch) {
  Physics physics({.floorFriction = 0.5, .rollingResistance = 0.03}, {{-50, 50, -50, 50}, {}, {}});
  const Primitive ball = shaped(Primitive::Shape::kEllipse, 0.11, 0.11);
  const Physics::Body rolling = physics.add({&ball, 1}, {0.43, Physics::Floor::kRolls}, {});
  const Physics::Body sliding = physics.add({&ball, 1}, {0.43, Physics::Floor::kSlides}, {0, 5, 0});
  physics.place(rolling, {}, {3.0, 0.0, 0.0});
  physics.place(sliding, {0, 5, 0}, {3.0, 0.0, 0.0});
  for (int i = 0; i < 2000; ++i) physics.step(kCycle);
  // v^2 / 2 mu g; Euler's steps are off by half a cycle of the first velocity.
  EXPECT_NEAR(physics.pose(rolling).x, 9.0 / (2.0 * 0.03 * kGravity), 0.02);
  EXPECT_NEAR(physics.pose(sliding).x, 9.0 / (2.0 * 0.5 * kGravity), 0.02);
  EXPECT_EQ(physics.velocity(sliding).x, 0.0);
}

}  // namespace
}  // namespace ortung

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "Physics.hpp"
#include "ortung/base/Random.hpp"

// Whatever files may say of shapes, from a millimetre on, the physics can live with.
namespace ortung {
namespace {

constexpr double kCycle = 0.01;

double anySize(Random& random) {  // 1 mm to 10 m, evenly in its logarithm [m]
  return 0.001 * std::pow(10.0, random.uniform(0.0, 4.0));
}

/// Half of them 1 to 5 mm thin.
double thinSize(Random& random) {
  return random.below(2) == 0 ? random.uniform(0.001, 0.005) : anySize(random);
}

Primitive anyTriangle(Random& random, const Point2& centre) {
  const double angle = random.uniform(-std::numbers::pi, std::numbers::pi);
  const double base = anySize(random);
  const double height = std::min(thinSize(random), base);
  const double foot = random.uniform(0.0, base);
  Primitive triangle;
  triangle.shape = Primitive::Shape::kTriangle;
  triangle.corners = {Point2{0.0, 0.0}, Point2{base, 0.0}, Point2{foot, height}};
  for (Point2& corner : triangle.corners) {
    const double x = corner.x - (base + foot) / 3.0;
    const double y = corner.y - height / 3.0;
    corner = {centre.x + x * std::cos(angle) - y * std::sin(angle),
              centre.y + x * std::sin(angle) + y * std::cos(angle)};
  }
  triangle.centre = centre;
  return triangle;
}

Primitive anyShape(Random& random, const Point2& centre) {
  const std::uint64_t kind = random.below(4);
  if (kind == 0) return anyTriangle(random, centre);
  Primitive shape;
  shape.shape = kind == 1 ? Primitive::Shape::kRectangle : Primitive::Shape::kEllipse;
  shape.centre = centre;
  shape.halfX = thinSize(random) / 2.0;
  shape.halfY = kind == 3 ? shape.halfX : anySize(random) / 2.0;
  shape.angle = random.uniform(-std::numbers::pi, std::numbers::pi);
  return shape;
}

bool isSane(const Physics& physics, Physics::Body body) {
  const Twist v = physics.velocity(body);
  return isFinite(physics.pose(body)) && std::isfinite(v.x) && std::isfinite(v.y) &&
         std::isfinite(v.theta);
}

/// Something flies at something, both of any shape, and the first then changes its own.
/// @param far how far the world goes on to the left and above [m]
void meet(std::uint64_t seed, const Point2& place, double far = 50.0) {
  Random random(seed, 3);
  Solids solids;
  solids.bounds = {place.x - far, place.x + 50.0, place.y - 50.0, place.y + far};
  solids.primitives.push_back(anyShape(random, place));
  Physics physics({.cycle = kCycle}, solids);
  const Primitive moved = anyShape(random, {});
  const Pose2 start{place.x - 10.0 + random.uniform(-1.0, 1.0), place.y + random.uniform(-1.0, 1.0),
                    random.uniform(-3.0, 3.0)};
  const auto floor = static_cast<Physics::Floor>(random.below(3));
  const Physics::Body body = physics.add({&moved, 1}, {1.0, floor}, start);
  const Primitive other = anyShape(random, {});
  const Physics::Body pushed =
      physics.add({&other, 1}, {1.0, Physics::Floor::kSlides}, {place.x - 5.0, place.y, 0.0});
  physics.place(body, start, {25.0, 0.0, random.uniform(-5.0, 5.0)});
  for (int i = 0; i < 50; ++i) {
    if (floor == Physics::Floor::kDrives) physics.want(body, {0.2, 0.0, 0.01});
    if (i == 25) {
      const Primitive next = anyShape(random, {});
      physics.reshape(body, {&next, 1}, {&next, 1});
    }
    physics.step(kCycle);
    ASSERT_TRUE(isSane(physics, body) && isSane(physics, pushed)) << seed << " " << i;
  }
}

TEST(ThinShapes, OfAMillimetreAndMoreEndNothing) {
  for (std::uint64_t seed = 0; seed < 2000; ++seed) ASSERT_NO_FATAL_FAILURE(meet(seed, {}));
}

TEST(ThinShapes, EndNothingFarFromTheOrigin) {
  for (std::uint64_t seed = 0; seed < 300; ++seed)
    ASSERT_NO_FATAL_FAILURE(meet(seed, {9900.0, -9900.0}));
}

TEST(ThinShapes, EndNothingAtTheEdgeOfALargeWorld) {
  for (std::uint64_t seed = 0; seed < 150; ++seed)
    ASSERT_NO_FATAL_FAILURE(meet(seed, {9900.0, -9900.0}, 19'000.0));
}

TEST(ThinShapes, AreWhereTheFileSays) {
  // Shapes of all kinds from 1 mm on, also far from the origin: what is 0.2 mm outside touches
  // nothing, what is 0.2 mm inside does. (Their corners are rounder than 0.2 mm only if thick.)
  for (const double x : {0.0, 9000.0})
    for (const double size : {0.001, 0.002, 0.005, 0.02, 1.0}) {
      Solids solids;
      solids.bounds = {x - 5.0, x + 5.0, -5.0, 5.0};
      Primitive plate;
      plate.centre = {x, 0.0};
      plate.halfX = size / 2.0;
      plate.halfY = 0.5;
      solids.primitives.push_back(plate);
      const Physics physics({}, solids);
      Primitive ball;
      ball.shape = Primitive::Shape::kEllipse;
      ball.halfX = ball.halfY = 0.1;
      const double touching = x + size / 2.0 + 0.1;
      EXPECT_TRUE(physics.isFree({&ball, 1}, {touching + 2e-4, 0.0, 0.0}, Physics::kNobody))
          << x << " " << size;
      EXPECT_FALSE(physics.isFree({&ball, 1}, {touching - 2e-4, 0.0, 0.0}, Physics::kNobody))
          << x << " " << size;
    }
}

/// A triangle of a size, its corners against the clock.
Primitive wedge(double base, double height) {
  Primitive triangle;
  triangle.shape = Primitive::Shape::kTriangle;
  triangle.corners = {Point2{0.0, 0.0}, Point2{base, 0.0}, Point2{0.4 * base, height}};
  triangle.centre = {1.4 * base / 3.0, height / 3.0};
  return triangle;
}

TEST(ThinShapes, OfTrianglesAllThreeSidesAreWhereTheFileSays) {
  // As above, in the middle of each side.
  for (const auto& [base, height] :
       {std::pair{0.01, 0.001}, {0.05, 0.05}, {0.5, 0.002}, {1.0, 0.5}, {4.0, 0.02}, {4.0, 3.0}}) {
    Solids solids;
    solids.bounds = {-10.0, 10.0, -10.0, 10.0};
    solids.primitives.push_back(wedge(base, height));
    const Physics physics({}, solids);
    const auto& corners = solids.primitives.front().corners;
    Primitive ball;
    ball.shape = Primitive::Shape::kEllipse;
    ball.halfX = ball.halfY = 0.1;
    for (std::size_t i = 0; i < 3; ++i) {
      const Point2& a = corners[i];
      const Point2& b = corners[(i + 1) % 3];
      const double length = std::hypot(b.x - a.x, b.y - a.y);
      const auto isFree = [&](double away) {
        const Pose2 place{(a.x + b.x) / 2.0 + away * (b.y - a.y) / length,
                          (a.y + b.y) / 2.0 - away * (b.x - a.x) / length, 0.0};
        return physics.isFree({&ball, 1}, place, Physics::kNobody);
      };
      EXPECT_TRUE(isFree(0.1 + 2e-4)) << base << " x " << height << ", side " << i;
      EXPECT_FALSE(isFree(0.1 - 2e-4)) << base << " x " << height << ", side " << i;
    }
  }
}

TEST(ThinShapes, StopABall) {
  for (const double size : {0.001, 0.003, 0.01}) {
    Solids solids;
    solids.bounds = {-20.0, 20.0, -5.0, 5.0};
    Primitive plate;
    plate.centre = {2.0, 0.0};
    plate.halfX = size / 2.0;
    plate.halfY = 4.0;
    solids.primitives.push_back(plate);
    for (const double speed : {0.5, 3.0, 12.0, 50.0}) {
      Physics physics({.restitution = 0.5, .rollingResistance = 0.0}, solids);
      Primitive ball;
      ball.shape = Primitive::Shape::kEllipse;
      ball.halfX = ball.halfY = 0.11;
      const Physics::Body body = physics.add({&ball, 1}, {0.43, Physics::Floor::kRolls}, {});
      physics.place(body, {}, {speed, 0.0, 0.0});
      for (int i = 0; i < 3.0 / speed / kCycle; ++i) physics.step(kCycle);
      EXPECT_NEAR(physics.velocity(body).x, -0.5 * speed, 1e-3 * speed) << size << " " << speed;
    }
  }
}

}  // namespace
}  // namespace ortung

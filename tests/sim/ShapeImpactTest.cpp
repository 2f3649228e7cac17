#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "Physics.hpp"
#include "ortung/base/Angles.hpp"
#include "ortung/base/Random.hpp"

// Impacts of rectangles, triangles and ellipses against eqs. (1) to (5) of the paper. Without
// friction the impulse J on the first body and what it does to the spins say where it acted: with
// n along J, the levers are l1 = I1 (Omega1 - omega1) / |J| and l2 = I2 (Omega2 - omega2) / -|J|,
// so along n the surfaces met with n (v1 - v2) + l1 omega1 - l2 omega2, which eq. (5) turns around.
namespace ortung {
namespace {

constexpr double kCycle = 0.01;
constexpr int kFiner = 40;  ///< parts of a cycle that is looked at closely
/// Round shapes are polygons, of which two corners may touch at once: that much of the velocity.
constexpr double kRound = 0.075;

struct State {
  std::array<Twist, 2> velocity;  ///< of the centres of mass
  std::array<Point2, 2> centre;
};

Primitive shapeOf(int kind) {
  Primitive shape;
  shape.shape = static_cast<Primitive::Shape>(kind % 3);
  shape.halfX = 0.25;
  shape.halfY = 0.12;
  if (kind == 3) {
    shape.shape = Primitive::Shape::kEllipse;
    shape.halfX = shape.halfY = 0.11;
  }
  shape.corners = {Point2{-0.2, -0.15}, Point2{0.25, -0.1}, Point2{-0.05, 0.25}};  // about (0, 0)
  return shape;
}

class TwoShapes {
 public:
  TwoShapes(int first, int second, Random& random, double restitution, double cycle = kCycle)
      : cycle_(cycle),
        physics_({.cycle = cycle,
                  .friction = 0.0,
                  .restitution = restitution,
                  .floorFriction = 0.0,
                  .rollingResistance = 0.0},
                 {{-20.0, 20.0, -20.0, 20.0}, {}, {}}) {
    for (const int kind : {first, second}) {
      const Primitive shape = shapeOf(kind);
      const bool isFirst = body_.empty();
      body_.push_back(physics_.add({&shape, 1},
                                   {random.uniform(0.5, 20.0), Physics::Floor::kSlides},
                                   {isFirst ? -1.0 : 1.0, 0.0, 0.0}));
    }
    physics_.place(body_[0], {-1.0, random.uniform(-0.2, 0.2), random.uniform(-3.0, 3.0)},
                   {random.uniform(0.2, 5.0), 0.0, random.uniform(-2.0, 2.0)});
    physics_.place(body_[1], {0.0, 0.0, random.uniform(-3.0, 3.0)},
                   {0.0, 0.0, random.uniform(-2.0, 2.0)});
  }

  State state() const {
    State state;
    for (std::size_t i = 0; i < 2; ++i) {
      const Point2 c = physics_.centreOfMass(body_[i]);
      const Pose2& p = physics_.pose(body_[i]);
      Twist v = physics_.velocity(body_[i]);
      v.x -= v.theta * (c.y - p.y);
      v.y += v.theta * (c.x - p.x);
      state.velocity[i] = v;
      state.centre[i] = c;
    }
    return state;
  }

  /// Steps until they hit each other; false if they miss.
  bool run(State& before) {
    for (int i = 0; i < 1000; ++i)
      if (step(before)) return true;
    return false;
  }
  /// Returns whether they hit each other in this step.
  bool step(State& before) {
    before = state();
    for (std::size_t i = 0; i < 2; ++i) {
      poseBefore_[i] = physics_.pose(body_[i]);
      velocityBefore_[i] = physics_.velocity(body_[i]);
    }
    physics_.step(cycle_);
    const State now = state();
    return std::abs(now.velocity[0].x - before.velocity[0].x) +
               std::abs(now.velocity[0].y - before.velocity[0].y) >
           1e-3;
  }
  /// Takes over where the same bodies were before their last step.
  void placeBefore(const TwoShapes& others) {
    for (std::size_t i = 0; i < 2; ++i)
      physics_.place(body_[i], others.poseBefore_[i], others.velocityBefore_[i]);
  }
  double mass(std::size_t i) const { return physics_.mass(body_[i]); }
  double inertia(std::size_t i) const { return physics_.inertia(body_[i]); }

 private:
  double cycle_;
  Physics physics_;
  std::array<Pose2, 2> poseBefore_;
  std::array<Twist, 2> velocityBefore_;
  std::vector<Physics::Body> body_;
};

struct Found {
  double before = 0.0;  ///< velocity of the surfaces along n [m/s]
  double after = 0.0;
  double apart = 0.0;  ///< how far the lines lie apart along which the bodies got their impulse [m]
};

Found measure(const TwoShapes& pair, const State& before, const State& after) {
  const Twist& v1 = before.velocity[0];
  const Point2 impulse{pair.mass(0) * (after.velocity[0].x - v1.x),
                       pair.mass(0) * (after.velocity[0].y - v1.y)};
  const double size = std::hypot(impulse.x, impulse.y);
  const Point2 n{impulse.x / size, impulse.y / size};
  const double lever1 = pair.inertia(0) * (after.velocity[0].theta - v1.theta) / size;
  const double lever2 =
      -pair.inertia(1) * (after.velocity[1].theta - before.velocity[1].theta) / size;
  const auto along = [&](const State& s) {
    return n.x * (s.velocity[0].x - s.velocity[1].x) + n.y * (s.velocity[0].y - s.velocity[1].y) +
           lever1 * s.velocity[0].theta - lever2 * s.velocity[1].theta;
  };
  // The lever is r x n: so the line of action is at c x n + lever from the origin.
  const auto line = [&](std::size_t i, double lever) {
    return after.centre[i].x * n.y - after.centre[i].y * n.x + lever;
  };
  return {along(before), along(after), std::abs(line(0, lever1) - line(1, lever2))};
}

/// How far the velocity after an impact is from what eq. (5) says, as a share of that before.
double offOf(const Found& found, double e) {
  return std::abs(found.after + e * found.before) / -found.before;
}

/// What happened within a cycle, looked at closely.
struct Closely {
  int impacts = 0;
  double mostOff = 0.0;  ///< of one of them
};

Closely lookClosely(TwoShapes& fine, const TwoShapes& pair, double e) {
  fine.placeBefore(pair);
  Closely found;
  State before;
  for (int i = 0; i < kFiner; ++i) {
    if (!fine.step(before)) continue;
    ++found.impacts;
    found.mostOff = std::max(found.mostOff, offOf(measure(fine, before, fine.state()), e));
  }
  return found;
}

TEST(ShapeImpact, ObeysNewtonsHypothesis) {
  Random random(11, 1);
  int impacts = 0;
  int isOff = 0;
  int repeated = 0;
  double mean = 0.0;
  double apart = 0.0;
  for (int i = 0; i < 4000; ++i) {
    const double e = random.uniform(0.0, 1.0);
    const int first = static_cast<int>(random.below(4));
    const int second = static_cast<int>(random.below(4));
    Random again = random;
    TwoShapes pair(first, second, random, e);
    State before;
    if (!pair.run(before)) continue;
    const Found found = measure(pair, before, pair.state());
    ++impacts;
    ASSERT_LT(found.before, 0.0) << i;  // the impulse pushes the first away
    const double off = offOf(found, e);
    mean += off;
    apart += found.apart;
    isOff += off > 0.02 ? 1 : 0;
    EXPECT_LT(found.apart, 0.1) << i << ": shapes " << first << " and " << second;
    if (off < kRound) continue;
    // One end of long shapes hits, they turn, and the other end hits within the same cycle. Each of
    // these impacts obeys eq. (5), while what they do together does not.
    ++repeated;
    TwoShapes fine(first, second, again, e, kCycle / kFiner);
    const Closely closely = lookClosely(fine, pair, e);
    EXPECT_GT(closely.impacts, 1) << i << ": shapes " << first << " and " << second << ": " << off;
    EXPECT_LT(closely.mostOff, kRound) << i << ": shapes " << first << " and " << second;
  }
  mean /= impacts;
  apart /= impacts;
  RecordProperty("impacts", impacts);
  RecordProperty("repeated", repeated);
  RecordProperty("mean_error", std::to_string(mean));
  EXPECT_GT(impacts, 3000);
  EXPECT_LT(mean, 0.0023);
  EXPECT_LT(isOff, 0.04 * impacts);
  EXPECT_GT(repeated, 5);
  EXPECT_LT(repeated, 0.008 * impacts);
  EXPECT_LT(apart, 0.0065);
}

}  // namespace
}  // namespace ortung

#include <gtest/gtest.h>

#include <cmath>

#include "Physics.hpp"
#include "ortung/base/Angles.hpp"
#include "ortung/base/Random.hpp"

// Where a ball goes that hits a post, against what two circles without friction do: along the line
// of their centres at the moment of the impact it comes back with e times its speed (paper, eq. 5),
// across it keeps its own.
namespace ortung {
namespace {

constexpr double kBall = 0.11;  ///< radius [m]
constexpr double kCycle = 0.01;

struct Shot {
  double speed = 3.0;   ///< [m/s]
  double offset = 0.0;  ///< of the post from the ball's line [m]
  double start = 1.0;   ///< way from the ball to the post [m]
};

/// Direction of the ball after the impact, from that before it [rad].
double deflectionOf(const Shot& shot, double post, double restitution) {
  const double across = shot.offset / (kBall + post);
  const double along = std::sqrt(1.0 - across * across);  // line of centres: (along, across)
  const double gained = (1.0 + restitution) * along;
  return std::atan2(-gained * across, 1.0 - gained * along);
}

double simulatedDeflection(const Shot& shot, const Primitive& post, double restitution,
                           const Point2& place) {
  Solids solids;
  solids.bounds = {place.x - 20.0, place.x + 20.0, place.y - 20.0, place.y + 20.0};
  Primitive there = post;
  there.centre = place;
  solids.primitives.push_back(there);
  Physics physics({.cycle = kCycle,
                   .friction = 0.0,
                   .restitution = restitution,
                   .floorFriction = 0.0,
                   .rollingResistance = 0.0},
                  solids);
  Primitive ball;
  ball.shape = Primitive::Shape::kEllipse;
  ball.halfX = ball.halfY = kBall;
  const Pose2 start{place.x - shot.start, place.y - shot.offset, 0.0};
  const Physics::Body body = physics.add({&ball, 1}, {0.43, Physics::Floor::kRolls}, start);
  physics.place(body, start, {shot.speed, 0.0, 0.0});
  for (int i = 0; i < 2.0 * shot.start / shot.speed / kCycle + 5; ++i) physics.step(kCycle);
  const Twist v = physics.velocity(body);
  return std::atan2(v.y, v.x);
}

struct Error {
  double mean = 0.0;   ///< [degree]
  double worst = 0.0;  ///< [degree]
};

Error errorOver(int shots, double radius, const Point2& place) {
  Random random(7, 1);
  Primitive post;
  post.shape = Primitive::Shape::kEllipse;
  post.halfX = post.halfY = radius;
  Error error;
  for (int i = 0; i < shots; ++i) {
    const Shot shot{random.uniform(0.5, 8.0), random.uniform(-0.9, 0.9) * (kBall + radius),
                    random.uniform(0.6, 1.0)};
    const double e = random.uniform(0.2, 1.0);
    const double off = degrees(std::abs(
        wrapAngle(simulatedDeflection(shot, post, e, place) - deflectionOf(shot, radius, e))));
    error.mean += off / shots;
    error.worst = std::max(error.worst, off);
  }
  return error;
}

TEST(Post, DeflectsABallAsTheEquationsSay) {
  for (const double radius : {0.05, 0.2}) {
    const Error error = errorOver(1000, radius, {});
    RecordProperty("mean", std::to_string(error.mean));
    EXPECT_LT(error.mean, 1.0);
    EXPECT_LT(error.worst, 5.0);
  }
}

}  // namespace
}  // namespace ortung

#pragma once

#include <algorithm>
#include <cmath>
#include <optional>

#include "Attack.hpp"
#include "Steering.hpp"

namespace ortung {

/// The ball rolls towards a random point of the goal's mouth, or of the part that the keeper does
/// not cover; the robot is behind it.
class Roll : public Strike {
 public:
  Roll(const Attack& attack, bool isBlind) : attack_(attack), isBlind_(isBlind) {}

  bool setUp(PlayerSeat& seat) override {
    constexpr double kBehind = 0.6;  // the robot [m]
    Random& random = seat.random();
    const FloorPoint from = attack_.somewhere(random, 3.0, 4.5, 2.0);
    const FloorPoint to = attack_.goal.before(0.0, aim(seat, random));
    const double arrives = random.uniform(2.0, 4.5);  // [m/s]
    const double way = std::hypot(to.x - from.x, to.y - from.y);
    const double speed = std::sqrt(arrives * arrives + 2.0 * attack_.braking * way);
    const Pose2 ball{from.x, from.y, angleTo(from, to)};
    return Attack::put(seat, ball * Pose2{-kBehind, 0.0, 0.0}, ball,
                       {speed * std::cos(ball.theta), speed * std::sin(ball.theta), 0.0});
  }
  void act(PlayerSeat& seat) override { Steering::stand(seat.robot()); }

 private:
  /// Returns the distance of the target to the left of the goal's middle [m].
  double aim(PlayerSeat& seat, Random& random) const {
    constexpr double kWithin = 0.15;  // the post [m]
    constexpr double kCovered = 0.4;  // covered distance on either side of the keeper's middle [m]
    const double end = attack_.halfMouth - kWithin;
    const auto keeper = isBlind_ ? std::nullopt : attack_.keeper(seat);
    if (!keeper) return random.uniform(-end, end);
    const double stands = keeper->y - attack_.goal.middle.y;
    const double right =
        std::max(stands - kCovered + end, 0.0);  // width that is open on the right [m]
    const double left = std::max(end - stands - kCovered, 0.0);
    const double along = random.uniform(0.0, right + left);
    return along < right ? along - end : end - (along - right);
  }

  Attack attack_;
  bool isBlind_;
};

/// The ball lies at the kicker of a stationary robot that faces the corner not covered by the
/// keeper; some time later it kicks.
class Shot : public Strike {
 public:
  explicit Shot(const Attack& attack) : attack_(attack) {}

  bool setUp(PlayerSeat& seat) override {
    constexpr double kAim = 0.03;  // standard deviation of its direction [rad]
    Random& random = seat.random();
    const FloorPoint at = attack_.somewhere(random, 2.5, 4.5, 2.0);
    const double error = kAim * random.gaussian();
    kickAt_ = seat.now() + fromSeconds(random.uniform(0.1, 0.6));
    kicked_ = false;
    return attack_.putWithBall(
        seat, {at.x, at.y, wrapAngle(angleTo(at, attack_.freeCorner(seat)) + error)});
  }
  void act(PlayerSeat& seat) override {
    Steering::stand(seat.robot());
    if (kicked_ || seat.now() < kickAt_) return;
    seat.robot().setManipulator("kicker", "kick");
    kicked_ = true;
  }

 private:
  Attack attack_;
  Timestamp kickAt_ = 0;
  bool kicked_ = false;
};

}  // namespace ortung

// Plays at a goal from situations that it makes itself: what goalkeepers are measured by.
#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>

#include "Attack.hpp"
#include "Steering.hpp"
#include "YardstickV1.hpp"
#include "ortung/core/Plugin.hpp"

namespace ortung {
namespace {

/// The ball rolls towards a random point of the goal's mouth; the robot stands behind it.
class Roll : public Strike {
 public:
  explicit Roll(const Attack& attack) : attack_(attack) {}

  bool setUp(PlayerSeat& seat) override {
    constexpr double kBehind = 0.6;   // the robot [m]
    constexpr double kWithin = 0.15;  // the post [m]
    Random& random = seat.random();
    const FloorPoint from =
        attack_.goal.before(random.uniform(3.0, 4.5), random.uniform(-2.0, 2.0));
    const FloorPoint to =
        attack_.goal.before(0.0, random.uniform(-1.0, 1.0) * (attack_.halfMouth - kWithin));
    const double arrives = random.uniform(2.0, 4.5);  // [m/s]
    const double way = std::hypot(to.x - from.x, to.y - from.y);
    const double speed = std::sqrt(arrives * arrives + 2.0 * attack_.braking * way);
    const Pose2 ball{from.x, from.y, angleTo(from, to)};
    return Attack::put(seat, ball * Pose2{-kBehind, 0.0, 0.0}, ball,
                       {speed * std::cos(ball.theta), speed * std::sin(ball.theta), 0.0});
  }
  void act(PlayerSeat& seat) override { Steering::stand(seat.robot()); }

 private:
  Attack attack_;
};

/// The ball lies at the kicker of a robot that stands and looks at the corner which the keeper
/// leaves open; some time later it kicks.
class Shot : public Strike {
 public:
  explicit Shot(const Attack& attack) : attack_(attack) {}

  bool setUp(PlayerSeat& seat) override {
    constexpr double kAim = 0.03;  // sigma [rad]
    Random& random = seat.random();
    const FloorPoint at = attack_.goal.before(random.uniform(2.5, 4.5), random.uniform(-2.0, 2.0));
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

/// Drives with the ball between its horns towards the goal, and kicks as soon as the keeper leaves
/// the way open that it looks along, or when it is near.
class Dribble : public Strike {
 public:
  explicit Dribble(const Attack& attack) : attack_(attack) {}

  bool setUp(PlayerSeat& seat) override {
    Random& random = seat.random();
    const FloorPoint at = attack_.goal.before(random.uniform(3.5, 5.0), random.uniform(-1.5, 1.5));
    shootsFrom_ = random.uniform(1.8, 2.8);
    kicked_ = false;
    const double off = random.uniform(-0.2, 0.2);
    return attack_.putWithBall(seat,
                               {at.x, at.y, wrapAngle(angleTo(at, attack_.goal.middle) + off)});
  }

  void act(PlayerSeat& seat) override {
    if (kicked_) return Steering::stand(seat.robot());
    const Pose2 pose = Attack::self(seat).pose;
    const Pose2 ball = inverse(pose) * Attack::ball(seat).pose;
    if (std::hypot(ball.x - attack_.ballAhead, ball.y) > kLost) return fetch(seat, pose, ball);
    const FloorPoint corner = attack_.freeCorner(seat);
    const double error = wrapAngle(angleTo({pose.x, pose.y}, corner) - pose.theta);
    const double depth = attack_.goal.depthOf(pose.x);
    if (depth < kNearest || (depth < shootsFrom_ && isOpen(seat, pose))) {
      seat.robot().setManipulator("kicker", "kick");
      kicked_ = true;
      return;
    }
    // The ball stays between the horns as long as it turns slowly.
    seat.robot().setRotationalVelocity(std::clamp(2.0 * error, -kTurn, kTurn));
    seat.robot().setTranslationalVelocity(kSpeed);
  }

 private:
  static constexpr double kSpeed = 0.8;    ///< with the ball [m/s]
  static constexpr double kTurn = 0.6;     ///< with the ball [rad/s]
  static constexpr double kLost = 0.15;    ///< farther from its place the ball is lost [m]
  static constexpr double kNearest = 1.3;  ///< here it kicks in any case [m]
  static constexpr double kGap = 0.4;      ///< of the keeper's middle from the ball's way [m]

  /// Whether the way ahead leads into the goal, and past the keeper.
  bool isOpen(PlayerSeat& seat, const Pose2& pose) const {
    const double ahead = std::cos(pose.theta) * -attack_.goal.inwards;
    if (ahead <= 0.2) return false;
    const auto placeAt = [&](double x) { return pose.y + (x - pose.x) * std::tan(pose.theta); };
    constexpr double kWithin = 0.12;  // half a ball [m]
    if (std::abs(placeAt(attack_.goal.middle.x) - attack_.goal.middle.y) >
        attack_.halfMouth - kWithin)
      return false;
    const auto keeper = attack_.keeper(seat);
    return !keeper || std::abs(placeAt(keeper->x) - keeper->y) > kGap;
  }
  /// Turns to the ball and drives up to it.
  static void fetch(PlayerSeat& seat, const Pose2&, const Pose2& ball) {
    const double bearing = std::atan2(ball.y, ball.x);
    seat.robot().setRotationalVelocity(std::clamp(3.0 * bearing, -2.0, 2.0));
    seat.robot().setTranslationalVelocity(std::abs(bearing) < 0.4 ? kSpeed : 0.0);
  }

  Attack attack_;
  double shootsFrom_ = 2.0;  ///< [m]
  bool kicked_ = false;
};

const std::vector<std::string> kKinds = {"roll", "shot", "dribble", "yardstick-v1"};

class StrikerPlayer : public Player {
 public:
  explicit StrikerPlayer(const Parameters& p)
      : kind_(p.choiceOr("kind", "shot", kKinds)), again_(p.numberOr("again_s", 0.0, {0.0, 1e6})) {
    attack_.halfMouth = p.numberOr("goal_width_m", 2.0, {0.3, 20.0}) / 2.0;
    attack_.braking = p.numberOr("braking_m_s2", attack_.braking, {0.0, 10.0});
  }

  std::filesystem::path robotFile() const override { return "striker.toml"; }
  double period() const override { return 0.02; }
  bool needsStage() const override { return true; }

  void begin(PlayerSeat& seat) override {
    attack_.goal = GoalSide::at(seat.field(), seat.game().directionOf(seat.team()));
    if (kind_ == "roll") strike_ = std::make_unique<Roll>(attack_);
    if (kind_ == "shot") strike_ = std::make_unique<Shot>(attack_);
    if (kind_ == "dribble") strike_ = std::make_unique<Dribble>(attack_);
    if (kind_ == "yardstick-v1") strike_ = std::make_unique<YardstickV1>(attack_.goal);
    setUp(seat);
  }

  bool senseAndAct(PlayerSeat& seat) override {
    if (again_ > 0.0 && toSeconds(seat.now() - begun_) >= again_) setUp(seat);
    strike_->act(seat);
    return true;
  }

 private:
  void setUp(PlayerSeat& seat) {
    constexpr int kTries = 50;
    begun_ = seat.now();
    for (int i = 0; i < kTries; ++i)
      if (strike_->setUp(seat)) return;
    throw std::runtime_error("found no room for robot and ball in " + std::to_string(kTries) +
                             " situations");
  }

  std::string kind_;
  double again_;  ///< [s]
  Attack attack_;
  std::unique_ptr<Strike> strike_;
  Timestamp begun_ = 0;
};

struct StrikerHelp : PlayerHelp {
  explicit StrikerHelp(const Parameters&)
      : PlayerHelp("plays at a goal from situations that it makes, to measure goalkeepers",
                   {{"kind", "roll|shot|dribble|yardstick-v1", "shot",
                     "a ball that rolls, a free shot, a dribbler; yardstick-v1 never changes"},
                    {"again_s", "s", "0", "how often it makes another situation; 0: only once"},
                    {"goal_width_m", "m", "2", "between the posts"},
                    {"braking_m_s2", "m/s^2", "0.2943", "how the floor brakes the ball"}}) {}
};

}  // namespace
}  // namespace ortung

ORTUNG_PLUGINS("striker", ortung::provide<ortung::Player, ortung::StrikerPlayer>("striker"),
               ortung::provide<ortung::PlayerHelp, ortung::StrikerHelp>("striker"));

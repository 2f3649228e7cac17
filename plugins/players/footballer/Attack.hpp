#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "Aim.hpp"
#include "Go.hpp"
#include "Intercept.hpp"
#include "ortung/base/Random.hpp"

namespace ortung::football {

/// The skill of a player.
struct Skill {
  double ballAhead = 0.28;  ///< distance from its own middle to that of a ball that it has [m]
  double shotRange = 4.5;   ///< distance from the goal within which it shoots [m]
  double carrySpeed = 1.0;  ///< speed with the ball [m/s]
  double carryTurn = 0.8;   ///< turn rate with the ball [rad/s]
  double carryTime = 5.0;   ///< time after which it must release the ball [s]
  double aimNoise = 0.04;   ///< standard deviation of the direction of its kicks [rad]
};

/// Takes the ball, dribbles it around others, passes or shoots at the goal.
class Attack {
 public:
  explicit Attack(const Skill& skill) : skill_(skill) {}

  /// Makes it pass: the taker of a restart must not score by itself.
  void oweAPass() { owesPass_ = true; }
  /// Resets it: another robot goes for the ball.
  void forget() {
    owesPass_ = false;
    aim_.reset();
    since_.reset();
  }

  /// @pre m.view.ball
  void act(const Moment& m, Random& random) {
    const FloorPoint ball = m.view.ballInRobot();
    const bool has = isHad(ball);
    if (!has) lastWithout_ = m.view.now;
    if (!since_ || !has) since_ = has ? since_ : std::optional<Timestamp>();
    if (has && !since_) since_ = m.view.now;
    choose(m, random);
    // Once the ball is between the horns it may turn with it; a short loss does not end that.
    if (has) return carry(m, ball);
    m.hands.hold(false, m.robot);
    if (isJammed(m) && poke(m)) return;
    fetch(m);
  }

  const std::optional<Aim>& aim() const { return aim_; }

 private:
  bool isHad(const FloorPoint& ball) const {
    return ball.x > 0.1 && ball.x < skill_.ballAhead + 0.07 && std::abs(ball.y) < 0.1;
  }
  /// Returns whether the ball has not come away for some time, e.g. from between two robots, or a
  /// restart is not taken.
  bool isJammed(const Moment& m) {
    const FloorPoint ball = m.view.ball->at;
    const bool isNear = lengthOf(ball - m.view.place()) < kNear;
    if (lengthOf(ball - lay_) > kSamePlace || !isNear) lay_ = ball, laySince_ = m.view.now;
    if (!owesPass_) owedSince_.reset();
    if (owesPass_ && !owedSince_) owedSince_ = m.view.now;
    if (!owedSince_) return m.view.now - laySince_ > kJammed;
    // Near the own goal most ways to the ball are wrong ones.
    const bool isAtHome = lengthOf(m.ownGoal() - ball) < 0.6 * m.ground.halfLength;
    return !isAtHome && m.view.now - *owedSince_ > kHurries;
  }
  /// Goes straight at the ball and kicks it away, whatever is aimed at. @returns whether it did; it
  /// does not if the ball could go towards the own goal
  bool poke(const Moment& m) {
    const FloorPoint from = m.view.place();
    const FloorPoint ball = m.view.ball->at;
    const FloorPoint way = unit(ball - from);
    if (isAtOwnGoal(m, from, ball)) return false;
    // Nor does it drive into a post before nothing else has helped.
    const bool isAtPost =
        std::any_of(m.ground.posts.begin(), m.ground.posts.end(), [&](const Disc& post) {
          return distanceToWay(post.at, from, ball + kBehind * way) < post.radius + kBallRadius;
        });
    if (isAtPost && m.view.now - laySince_ < 2 * kJammed) return false;
    const double toBall = angleOf(way);
    const double error = wrapAngle(toBall - m.view.pose.theta);
    if (lengthOf(ball - from) > 1.0) {
      go_.to(m, ball, toBall, m.chassis.limits().speed);
      return true;
    }
    if (std::abs(error) < 0.3 && lengthOf(ball - from) < skill_.ballAhead + 0.1)
      m.hands.kick(false, m.robot);
    m.chassis.move(m.view.pose, m.chassis.limits().speed * way, toBall, m.robot);
    return true;
  }
  /// Returns the distance behind the ball from which it approaches it [m].
  double behind() const { return skill_.ballAhead + kBehind; }
  double had(Timestamp now) const { return since_ ? toSeconds(now - *since_) : 0.0; }

  /// Chooses what to do with the ball. A choice holds for some time.
  void choose(const Moment& m, Random& random) {
    const Timestamp keeps = owesPass_ ? 6 * kKeeps : kKeeps;
    if (aim_ && m.view.now - chosen_ < keeps && aim_->kind != Aim::Kind::kCarry) return;
    const Aim::Kind before = aim_ ? aim_->kind : Aim::Kind::kCarry;
    aim_ = best(m);
    chosen_ = m.view.now;
    if (aim_->kind != before) error_ = skill_.aimNoise * random.gaussian();
  }
  Aim best(const Moment& m) const {
    const FloorPoint ball = m.view.ball->at;
    if (owesPass_) {
      const auto mate = bestMate(m, ball, m.hands.canHold() ? 4.0 : 0.5);
      if (mate && hasRoomBehind(m, *mate, behind())) return {Aim::Kind::kPass, *mate};
      return {Aim::Kind::kClearance, clearance(m, behind())};
    }
    const double toGoal = lengthOf(m.otherGoal() - ball);
    const auto corner = openCorner(m, ball);
    if (toGoal < skill_.shotRange && corner) return {Aim::Kind::kShot, *corner};
    const bool isLate = had(m.view.now) > skill_.carryTime;
    const bool isPressed = m.view.opponentTo(ball) < kPressed;
    const bool isShutOut = toGoal < skill_.shotRange;  // no corner is open, or it would have shot
    if (isPressed || isLate || isShutOut)
      if (const auto mate = bestMate(m, ball, isLate || isShutOut ? 3.0 : 0.5))
        return {Aim::Kind::kPass, *mate};
    if (toGoal < 0.4 * skill_.shotRange || (isLate && toGoal < 1.6 * skill_.shotRange))
      return {Aim::Kind::kShot, corner.value_or(m.otherGoal())};
    const bool isAtHome = lengthOf(m.ownGoal() - ball) < 0.6 * m.ground.halfLength;
    if (isLate || (isPressed && isAtHome)) return {Aim::Kind::kClearance, clearance(m, behind())};
    return {Aim::Kind::kCarry, m.otherGoal()};
  }
  /// Approaches the ball from the side opposite to its target.
  void fetch(const Moment& m) {
    const RollingBall& ball = *m.view.ball;
    const FloorPoint from = m.view.place();
    const Meeting meeting = meet(ball, m.view.pose, m.chassis.limits());
    const bool isRolling = ball.speed() > kRolling;
    const FloorPoint at = m.ground.within(isRolling ? meeting.at : ball.at, -0.3);
    if (isRolling && meeting.after > 0.3) {
      // It intercepts the ball, facing it.
      const FloorPoint place = at - skill_.ballAhead * unit(ball.at - at);
      return go_.to(m, place, angleOf(ball.at - from), m.chassis.limits().speed);
    }
    const FloorPoint aim = unit(aim_->target - at);
    const double toBall = angleOf(at - from);
    const double off = std::abs(wrapAngle(angleOf(aim) - toBall));
    const double away = lengthOf(at - from);
    // With flaps it can take the ball from any side and turn with it.
    const bool isContested = m.view.opponentTo(at) < kPressed;
    const double cone = m.hands.canHold() ? 2.2 : isContested ? 1.1 : away < 0.6 ? 0.5 : 0.3;
    if (off > cone) {
      return go_.to(m, placeBehind(at, aim_->target, behind()), angleOf(aim),
                    m.chassis.limits().speed, {{ball.at, kBallRadius}});
    }
    const double error = wrapAngle(toBall - m.view.pose.theta);
    const double gap = std::max(away - skill_.ballAhead, 0.0);
    const double speed = std::min(m.chassis.limits().speed, 0.35 + 1.5 * gap);
    if (away > 1.0) return go_.to(m, at, toBall, speed);
    m.chassis.move(m.view.pose, (std::abs(error) < 0.4 ? speed : 0.1) * towards(toBall), toBall,
                   m.robot);
  }

  /// Returns whether to kick now: the heading is the wanted one, or as good.
  bool isAimed(const Moment& m, double error) const {
    constexpr double kAimed = 0.06, kAnywhere = 0.4;  // [rad]
    constexpr double kPost = 0.2;                     // least gap to a post [m]
    if (aim_->kind == Aim::Kind::kCarry) return false;
    if (aim_->kind == Aim::Kind::kClearance) return std::abs(error) < kAnywhere;
    if (std::abs(error) < kAimed) return true;
    if (aim_->kind != Aim::Kind::kShot) return false;
    const FloorPoint way = towards(m.view.pose.theta);
    const FloorPoint from = m.view.place();
    if (way.x * m.forward < 0.3) return false;
    const FloorPoint hit = from + ((m.otherGoal().x - from.x) / way.x) * way;
    return std::abs(hit.y) < m.ground.halfMouth - kPost &&
           isLaneFree(m.view, from, hit, kBallRadius);
  }

  void carry(const Moment& m, const FloorPoint& ball) {
    if (ball.x < skill_.ballAhead + 0.02 && std::abs(ball.y) < 0.05) m.hands.hold(true, m.robot);
    const Pose2& pose = m.view.pose;
    const FloorPoint from = m.view.place();
    const double wanted = angleOf(aim_->target - from) + error_;
    const double error = wrapAngle(wanted - pose.theta);
    if (isAimed(m, error) && m.view.now - lastWithout_ > kSettles) {
      if (m.hands.kick(aim_->kind == Aim::Kind::kPass, m.robot)) {
        owesPass_ = false;
        aim_.reset();
        since_.reset();
      }
      return m.chassis.drive(0.3, 0.0, m.robot);
    }
    double way = wanted;
    if (aim_->kind == Aim::Kind::kCarry) {
      std::vector<Disc> discs;
      for (const Other& other : m.view.others) discs.push_back({other.at, other.radius + 0.1});
      way = go_.direction(from, aim_->target, m.view.radius, discs).value_or(wanted);
    }
    const double off = wrapAngle(way - pose.theta);
    const double most = m.hands.canHold() ? 2.0 * skill_.carryTurn : skill_.carryTurn;
    const double turn = std::clamp(2.5 * off, -most, most);
    const bool isTurning = std::abs(off) > 0.6;
    const double speed = isTurning && m.hands.canHold() ? 0.3 : isTurning ? 0.5 : 1.0;
    m.chassis.drive(speed * skill_.carrySpeed, turn, m.robot);
  }

  static constexpr Timestamp kKeeps = 600'000;  ///< how long an aim is kept [us]
  /// How long it must have a ball before it acts [us].
  static constexpr Timestamp kSettles = 100'000;
  /// Distance of an opponent from the ball that counts as pressure [m].
  static constexpr double kPressed = 0.9;
  static constexpr double kRolling = 0.5;  ///< speed below which a ball counts as lying [m/s]
  /// Distance behind the ball from which it approaches [m].
  static constexpr double kBehind = 0.28;

  static constexpr double kNear = 1.2;       ///< farthest that a robot is that tries to get it [m]
  static constexpr double kSamePlace = 0.3;  ///< a ball that stays so near has not moved [m]
  static constexpr Timestamp kJammed = 3'500'000;  ///< how long a ball must lie to be jammed [us]
  /// How long it prepares a restart before it takes it in any way [us].
  static constexpr Timestamp kHurries = 4'000'000;

  Skill skill_;
  Go go_;
  FloorPoint lay_;  ///< place of the ball since laySince_
  Timestamp laySince_ = 0;
  std::optional<Timestamp> owedSince_;  ///< time since which it owes a pass
  std::optional<Aim> aim_;
  Timestamp chosen_ = 0;
  std::optional<Timestamp> since_;  ///< time since which it has the ball; nothing: it has not
  Timestamp lastWithout_ = 0;
  double error_ = 0.0;  ///< error of its current aim [rad]
  bool owesPass_ = false;
};

}  // namespace ortung::football

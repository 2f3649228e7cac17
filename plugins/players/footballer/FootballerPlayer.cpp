// Plays football in the field: the robot that can reach the ball first attacks, the others cover
// and support; they share roles by messages (docs/matches.md).
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "Attack.hpp"
#include "Eyes.hpp"
#include "Places.hpp"
#include "Roles.hpp"
#include "Steering.hpp"
#include "TeamTalk.hpp"
#include "Unjam.hpp"
#include "ortung/base/Angles.hpp"
#include "ortung/core/Plugin.hpp"
#include "ortung/formats/PlacesData.hpp"
#include "ortung/formats/PoseData.hpp"
#include "ortung/mcl_player/SelfLocalization.hpp"

namespace ortung::football {
namespace {

struct Settings {
  std::string sees;
  std::optional<double> speed;  ///< greatest speed [m/s]
  double period;                ///< time between two decisions [s]
  double braking;               ///< deceleration of a rolling ball [m/s^2]
  Skill skill;
  Ground sizes;
  WheelPlaces wheels;

  explicit Settings(const Parameters& p) {
    sees = p.choiceOr("sees", "truth", {"truth", "features", "localized"});
    speed = speedOption(p);
    period = p.numberOr("period_s", 0.04, {0.01, 1.0});
    braking = p.numberOr("braking_m_s2", 0.2943, {0.0, 10.0});
    skill.aimNoise = radians(p.numberOr("aim_noise_deg", 2.5, {0.0, 90.0}));
    skill.shotRange = p.numberOr("shot_range_m", 0.0, {0.0, 50.0});
    skill.carryTime = p.numberOr("carry_s", skill.carryTime, {0.5, 1e6});
    skill.ballAhead = p.numberOr("ball_ahead_m", skill.ballAhead, {0.05, 2.0});
    sizes.halfLength = p.numberOr("length_m", 0.0, {0.0, 1000.0}) / 2.0;
    sizes.halfWidth = p.numberOr("width_m", 0.0, {0.0, 1000.0}) / 2.0;
    sizes.halfMouth = p.numberOr("goal_width_m", 0.0, {0.0, 100.0}) / 2.0;
    wheels = wheelsOption(p);
  }
};

std::optional<Pose2> groundTruth(PlayerSeat& seat) {
  return seat.container().get<PoseData>({.type = "groundTruth"});
}

/// Returns whether it is commanded by the speeds of three wheels.
bool hasThreeWheels(const RobotAbilities& abilities) {
  return abilities.motionKind == motion::kOmni3;
}

class FootballerPlayer : public Player {
 public:
  explicit FootballerPlayer(const Parameters& p) : settings_(p), mates_(settings_.braking) {}

  std::filesystem::path robotFile() const override { return "f2000_player.toml"; }
  double period() const override { return settings_.period; }
  bool needsStage() const override { return settings_.sees == "truth"; }
  bool needsTables() const override { return settings_.sees == "localized"; }
  std::optional<BelievedPose> believedPose() const override { return believed_; }

  void begin(PlayerSeat& seat) override {
    ground_ = Ground::of(seat.field(), settings_.sizes);
    Skill skill = settings_.skill;
    if (skill.shotRange <= 0.0) skill.shotRange = 0.7 * ground_.halfLength;
    const RobotAbilities& able = seat.abilities();
    std::optional<WheelPlaces> wheels;
    if (hasThreeWheels(able)) wheels = settings_.wheels;
    chassis_.emplace(limitsOf(seat, settings_.speed), wheels);
    hands_.emplace(able);
    attack_.emplace(skill);
    eyes_.emplace(poseFor(seat), settings_.braking);
  }

  bool senseAndAct(PlayerSeat& seat) override {
    mates_.hear(seat.heard(), seat.now());
    std::optional<View> view = eyes_->look(seat, mates_);
    if (view) believed_ = BelievedPose{seat.now(), view->pose};
    if (!view) {                     // its pose is unknown: it turns to see more
      constexpr double kTurn = 0.8;  // [rad/s]
      chassis_->drive(0.0, seat.game().mayPlay(seat.team()) ? kTurn : 0.0, seat.robot());
      return true;
    }
    const double forward = seat.game().directionOf(seat.team());
    const Moment moment{*view, ground_, *chassis_, *hands_, seat.robot(), forward};
    if (view->ball) {
      lastBall_ = view->ball->at;
      if (seat.game().phase == Game::Phase::kReady) view->ball->speedX = view->ball->speedY = 0.0;
    }
    const FloorPoint ball = view->ball ? view->ball->at : guess(seat.game(), forward);
    const bool isRestart = seat.game().phase == Game::Phase::kReady;
    const double cost = costOf(moment, ball, isRestart);
    talk(seat, *view, cost);
    if (!seat.game().mayPlay(seat.team())) {
      role_ = Role::kCover;
      attack_->forget();
      hands_->hold(false, seat.robot());
      unjam_.act(moment, false, seat.random());
      chassis_->stand(seat.robot());
      return true;
    }
    play(seat, moment, ball, cost);
    return true;
  }

 private:
  /// Returns the source of its pose; empty: everything is taken from the stage.
  Eyes::Pose poseFor(PlayerSeat& seat) {
    if (settings_.sees == "truth") return {};
    if (settings_.sees == "features") return groundTruth;
    self_ = std::make_unique<SelfLocalization>(seat);
    return [this](PlayerSeat& here) -> std::optional<Pose2> {
      self_->update(here);
      const auto estimate = self_->estimate(here.now());
      if (!estimate || estimate->status == TrackStatus::kLost) return std::nullopt;
      return estimate->pose;
    };
  }

  /// Returns the time until it has the ball on the right side [s]; an attacker has a bonus, so that
  /// roles are stable.
  double costOf(const Moment& m, const FloorPoint& ball, bool isRestart) const {
    constexpr double kNever = 1000.0;  // or last of all if the ball is not seen
    // At a restart nobody else comes for the ball, so one taker is better than the nearest one.
    const double loyalty = isRestart ? 2.0 : 0.5;  // [s]
    constexpr double kWrongSide = 0.8;             // [s]
    if (!m.view.ball) return kNever + lengthOf(ball - m.view.place());
    DriveLimits limits = m.chassis.limits();
    constexpr double kAtOnce = 1e3;                 // [rad/s]
    if (m.chassis.isOmni()) limits.turn = kAtOnce;  // it turns on its way
    const Meeting meeting = meet(*m.view.ball, m.view.pose, limits);
    const FloorPoint way = unit(meeting.at - m.view.place());
    const FloorPoint wanted = unit(m.otherGoal() - meeting.at);
    const double wrong = 0.5 * (1.0 - dot(way, wanted));
    return meeting.after + kWrongSide * wrong - (role_ == Role::kAttack ? loyalty : 0.0);
  }

  void talk(PlayerSeat& seat, const View& view, double cost) {
    constexpr Timestamp kPeriod = 100'000;  // [us]
    if (view.now < nextWord_) return;
    nextWord_ = view.now + kPeriod;
    seat.say(Word{cost, view.place(), eyes_->ownBall()}.text());
    // The same message for mates that read it like a sensor (plugin `teammate`).
    constexpr double kOwn = 0.05;   // approximate standard deviation of its own pose [m], [rad]
    constexpr double kBall = 0.15;  // approximate standard deviation of the ball's place [m]
    seat.say(toText(Place{Place::Kind::kRobot, seat.name(), fixOf(view.pose, kOwn, kOwn)}));
    if (const auto& ball = eyes_->ownBall())
      seat.say(toText(Place{Place::Kind::kBall, "ball",
                            fixOf({ball->at.x, ball->at.y, 0.0}, kBall, Place::kNoHeading)}));
  }

  static PoseFixData::Fix fixOf(const Pose2& pose, double sigma, double headingSigma) {
    const double s = sigma * sigma;
    return {pose, {s, 0.0, 0.0, 0.0, s, 0.0, 0.0, 0.0, headingSigma * headingSigma}};
  }

  void play(PlayerSeat& seat, const Moment& m, const FloorPoint& ball, double cost) {
    std::vector<Candidate> all = {{seat.name(), cost, m.view.place()}};
    for (const auto& [name, told] : mates_.told())
      all.push_back({name, told.word.cost, told.word.at});
    role_ =
        shareRoles(std::move(all), seat.name(), coverPlace(ground_, m.forward, ball), m.forward);
    if (role_ != Role::kAttack) {
      attack_->forget();
      if (unjam_.act(m, isOnTheWay_, seat.random())) return;
      return takePlace(m, ball);
    }
    if (unjam_.act(m, true, seat.random())) return;
    if (!m.view.ball) {  // it searches for the ball
      attack_->forget();
      m.hands.hold(false, m.robot);
      return go_.to(m, ball, angleOf(ball - m.view.place()), m.chassis.limits().speed);
    }
    if (isToTake(seat)) attack_->oweAPass();
    attack_->act(m, seat.random());
  }

  /// Returns the likely place of an unseen ball: where a restart puts it, or where it was last
  /// seen.
  FloorPoint guess(const Game& game, double forward) const {
    const double side = lastBall_.y < 0.0 ? -1.0 : 1.0;
    if (game.phase != Game::Phase::kReady && game.phase != Game::Phase::kStopped) return lastBall_;
    switch (game.restart) {
      case Game::Restart::kKickOff:
        return {};
      case Game::Restart::kCorner:
        return {forward * ground_.halfLength, side * ground_.halfWidth};
      case Game::Restart::kGoalKick:
        return {-forward * 0.93 * ground_.halfLength, side * 1.6 * ground_.halfMouth};
      default:
        return lastBall_;
    }
  }

  /// Returns whether its team has a restart from which the taker must not score.
  static bool isToTake(PlayerSeat& seat) {
    const Game& game = seat.game();
    return game.phase == Game::Phase::kReady && game.restart != Game::Restart::kPenalty &&
           game.restart != Game::Restart::kDroppedBall;
  }

  /// Goes to the place of its role, and faces the ball.
  void takePlace(const Moment& m, const FloorPoint& ball) {
    constexpr double kNear = 0.15, kFar = 0.35;  // [m]
    constexpr double kClear = 0.4;               // distance from the ball [m]
    m.hands.hold(false, m.robot);
    const FloorPoint place = placeOf(role_, ground_, m.forward, ball);
    const double away = lengthOf(place - m.view.place());
    isOnTheWay_ = away > (isOnTheWay_ ? kNear : kFar);
    const double heading = angleOf(ball - m.view.place());
    if (!isOnTheWay_) return m.chassis.move(m.view.pose, {}, heading, m.robot);
    go_.to(m, place, heading, m.chassis.limits().speed, {{ball, kClear}});
  }

  Settings settings_;
  Ground ground_;
  std::optional<Chassis> chassis_;
  std::optional<Hands> hands_;
  std::unique_ptr<SelfLocalization> self_;
  std::optional<Eyes> eyes_;
  std::optional<Attack> attack_;
  Mates mates_;
  std::optional<BelievedPose> believed_;
  Go go_;
  Unjam unjam_;
  Role role_ = Role::kCover;
  bool isOnTheWay_ = false;
  FloorPoint lastBall_;  ///< place where the ball was last seen
  Timestamp nextWord_ = 0;
};

struct FootballerHelp : PlayerHelp {
  explicit FootballerHelp(const Parameters&)
      : PlayerHelp(
            "plays football in the field, in a team that shares roles by messages",
            {{"sees", "truth|features|localized", "truth",
              "where everything really is; or ball and robots by its camera, and its pose by "
              "ground "
              "truth or by MCL"},
             kSpeedOption,
             {"aim_noise_deg", "deg", "2.5", "standard deviation of the direction of its kicks"},
             {"shot_range_m", "m", "0.35 of the field's length",
              "distance from the goal within which it shoots"},
             {"carry_s", "s", "5", "how long it keeps the ball at most"},
             {"ball_ahead_m", "m", "0.28", "distance from its middle to a ball that it has"},
             {"braking_m_s2", "m/s^2", "0.2943", "deceleration of a rolling ball that it assumes"},
             {"length_m", "m", "of the field", "distance between the goal lines"},
             {"width_m", "m", "of the field", "distance between the touch lines"},
             {"goal_width_m", "m", "of the field", "distance between the posts"},
             kWheelAnglesOption,
             kWheelDistanceOption,
             {"period_s", "s", "0.04", "time between two decisions"}}) {}
};

}  // namespace
}  // namespace ortung::football

ORTUNG_PLUGINS("footballer",
               ortung::provide<ortung::Player, ortung::football::FootballerPlayer>("footballer"),
               ortung::provide<ortung::PlayerHelp, ortung::football::FootballerHelp>("footballer"));

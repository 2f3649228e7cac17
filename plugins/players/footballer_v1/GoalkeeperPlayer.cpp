// FROZEN, a part of the team footballer-v1: docs/matches.md tells why. Never changed; improvements
// are made in the players of today. Keeps a goal by one of six policies (paper, section 5.1). It
// moves forwards and backwards along a line before its goal, so any robot can do it.
#include <cmath>
#include <deque>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "Chassis.hpp"
#include "ComingOut.hpp"
#include "GoalSide.hpp"
#include "Ground.hpp"
#include "OwnSight.hpp"
#include "Policy.hpp"
#include "Steering.hpp"
#include "ortung/core/Plugin.hpp"

namespace ortung {
namespace {

const std::vector<std::string> kPolicies = {"still",    "random",       "pattern",
                                            "blocking", "intercepting", "mixed"};

struct Settings {
  KeeperPolicy policy = KeeperPolicy::kIntercepting;
  SightMode sees = SightMode::kTruth;
  double speed = 1.5;       ///< greatest speed [m/s]
  double delay = 0.0;       ///< delay of its sight [s]
  double noise = 0.0;       ///< noise of its sight: standard deviation of both coordinates [m]
  double period = 0.04;     ///< time between two decisions [s]
  double lineOut = 0.5;     ///< distance of its line from the goal line [m]
  double reach = 0.75;      ///< how far it goes to either side of the goal's middle [m]
  double slack = 0.0;       ///< distance from its line beyond which it steers back [m]
  double braking = 0.2943;  ///< deceleration of a rolling ball [m/s^2]: 0.03 of gravity
  /// Distance from the goal's middle within which it leaves its line for a slow ball [m]; 0: never.
  double comesOut = 0.0;
  WheelPlaces wheels;  ///< wheels of a robot that has three

  explicit Settings(const Parameters& p) {
    const std::string name = p.choiceOr("policy", "intercepting", kPolicies);
    policy = static_cast<KeeperPolicy>(std::find(kPolicies.begin(), kPolicies.end(), name) -
                                       kPolicies.begin());
    sees = OwnSight::read(p);
    speed = p.numberOr("speed_m_s", speed, {0.0, 10.0});
    delay = p.numberOr("delay_s", delay, {0.0, 5.0});
    noise = p.numberOr("noise_m", noise, {0.0, 5.0});
    period = p.numberOr("period_s", period, {0.01, 1.0});
    lineOut = p.numberOr("line_m", lineOut, {0.1, 5.0});
    reach = p.numberOr("reach_m", reach, {0.0, 10.0});
    slack = p.numberOr("slack_m", slack, {0.0, 1.0});
    braking = p.numberOr("braking_m_s2", braking, {0.0, 10.0});
    comesOut = p.numberOr("comes_out_m", comesOut, {0.0, 10.0});
    wheels = wheelsOption(p);
  }
};

class GoalkeeperPlayer : public Player {
 public:
  explicit GoalkeeperPlayer(const Parameters& p)
      : settings_(p),
        own_(settings_.sees),
        track_(settings_.braking, 0.0, isExact() ? BallTrack::kMostExact : BallTrack::kMostNoisy) {}

  std::filesystem::path robotFile() const override { return own_.robotFile("goalkeeper"); }
  double period() const override { return settings_.period; }
  bool needsStage() const override { return own_.isTruth(); }
  bool needsTables() const override { return own_.needsTables(); }
  std::optional<BelievedPose> believedPose() const override { return own_.believed(); }

  void begin(PlayerSeat& seat) override {
    limits_ = limitsOf(seat, settings_.speed);
    takeGoal(seat);
  }

  bool senseAndAct(PlayerSeat& seat) override {
    if (seat.game().directionOf(seat.team()) != direction_) takeGoal(seat);  // after half-time
    own_.update(seat);
    const std::optional<Pose2>& pose = own_.pose();
    if (!pose) return true;  // there are no readings yet
    look(seat, *pose);
    if (!seat.game().mayPlay(seat.team())) {
      Steering::stand(seat.robot());
      return true;
    }
    if (out_ && out_->act(seat.now(), *pose, newestBall(seat.now()), *chassis_, seat.robot()))
      return true;
    const std::optional<double> wanted =
        mind_->decide(seat.now(), pose->y, newestBall(seat.now()), seat.random());
    if (!wanted || limits_.speed <= 0.0) {
      Steering::stand(seat.robot());
    } else if (isAway(*pose)) {
      Steering(limits_).steer(*pose, {line_.x, line_.goal.y}, seat.robot());
    } else {
      slide(*pose, *wanted, seat.robot());
    }
    return true;
  }

 private:
  /// Distance from its line beyond which it returns to it [m].
  static constexpr double kAway = 0.4;
  /// Standard deviations of its start: it assumes that it was placed on its line.
  static constexpr double kPlacedWithin = 0.4;  ///< standard deviation of its position [m]
  static constexpr double kPlacedTurned = 0.1;  ///< standard deviation of its heading [rad]

  struct Sight {
    Timestamp stamp = 0;
    FloorPoint at;
    double sigma = 0.0;  ///< standard deviation of a coordinate [m]
  };

  /// Takes the place before the goal that its team defends now.
  void takeGoal(PlayerSeat& seat) {
    direction_ = seat.game().directionOf(seat.team());
    goal_ = GoalSide::at(seat.field(), -direction_);
    line_ = {goal_.middle, goal_.before(settings_.lineOut, 0.0).x, settings_.reach};
    mind_.emplace(settings_.policy, line_);
    if (settings_.comesOut > 0.0) prepareToComeOut(seat);
    own_.begin(seat, {line_.x, goal_.middle.y, std::numbers::pi / 2.0}, kPlacedWithin,
               kPlacedTurned);
  }
  void prepareToComeOut(PlayerSeat& seat) {
    const RobotAbilities& able = seat.abilities();
    // Out there it is in a hurry: the greatest speed on its line is not meant.
    chassis_.emplace(able.limits, able.motionKind == motion::kOmni3
                                      ? std::optional(settings_.wheels)
                                      : std::nullopt);
    Ground sizes{1.0, 1.0, 0.0, {}};  // only the width of the goal matters
    sizes = Ground::of(seat.field(), sizes);
    out_.emplace(settings_.comesOut, goal_, sizes.halfMouth, able.radius);
  }

  bool isExact() const { return own_.isTruth() && settings_.noise == 0.0; }
  bool isAway(const Pose2& pose) const {
    return std::abs(pose.x - line_.x) > kAway ||
           std::abs(pose.y - line_.goal.y) > line_.reach + kAway;
  }

  /// Returns the sighting of the ball, in the field frame by the keeper's own pose.
  std::optional<Sight> sight(PlayerSeat& seat, const Pose2& pose) const {
    if (own_.isTruth()) {
      for (const StagedThing& thing : seat.stage()->things())
        if (thing.kind == "ball") return Sight{seat.now(), {thing.pose.x, thing.pose.y}};
      return std::nullopt;
    }
    const auto ball = own_.ball(seat);
    if (!ball) return std::nullopt;
    const Pose2 at = pose * ball->inRobot;
    return Sight{ball->stamp, {at.x, at.y}, ball->sigma};
  }

  /// Takes a sighting, which becomes known after the delay.
  void look(PlayerSeat& seat, const Pose2& pose) {
    if (auto seen = sight(seat, pose); seen && seen->stamp > newest_) {
      newest_ = seen->stamp;
      if (settings_.noise > 0.0) {
        seen->at.x += settings_.noise * seat.random().gaussian();
        seen->at.y += settings_.noise * seat.random().gaussian();
        seen->sigma = std::hypot(seen->sigma, settings_.noise);
      }
      coming_.push_back(*seen);
    }
    const Timestamp known = seat.now() - fromSeconds(settings_.delay);
    for (; !coming_.empty() && coming_.front().stamp <= known; coming_.pop_front())
      track_.see(coming_.front().stamp, coming_.front().at, coming_.front().sigma);
  }

  /// Returns the ball, extrapolated from its last sighting to now.
  std::optional<RollingBall> newestBall(Timestamp now) const {
    std::optional<RollingBall> ball = track_.ball();
    if (!ball) return ball;
    const double passed = toSeconds(now - track_.lastSeen());
    const double v = ball->speed();
    ball->at = ball->later(passed);
    const double share = v > 0.0 ? std::max(0.0, 1.0 - ball->braking * passed / v) : 0.0;
    ball->speedX *= share;
    ball->speedY *= share;
    return ball;
  }

  /// Moves along its line, forwards or backwards depending on its heading.
  void slide(const Pose2& pose, double wanted, RobotCommands& robot) const {
    const double across = std::sin(pose.theta) >= 0.0 ? 1.0 : -1.0;
    const double away = wanted - pose.y;
    // The greatest speed from which 0.8 of its acceleration still stops it in time.
    const double fast =
        std::min({limits_.speed, std::sqrt(1.6 * limits_.acceleration * std::abs(away)),
                  8.0 * std::abs(away)});
    const double speed = std::copysign(fast, away) * across;
    constexpr double kMoves = 0.1;  // it can't steer if it is slower [m/s]
    const double off = line_.x - pose.x;
    const bool steers = std::abs(speed) > kMoves && std::abs(off) > settings_.slack;
    const double tilt = steers ? std::clamp(2.0 * off / speed, -0.3, 0.3) : 0.0;
    const double error = wrapAngle(across * (std::numbers::pi / 2.0 - tilt) - pose.theta);
    robot.setRotationalVelocity(std::clamp(5.0 * error, -limits_.turn, limits_.turn));
    constexpr double kAcross = 0.6;  // for larger errors it turns first [rad]
    robot.setTranslationalVelocity(std::abs(error) < kAcross ? speed : 0.0);
  }

  Settings settings_;
  OwnSight own_;
  double direction_ = 1.0;  ///< direction in which its team plays along x, 1 or -1
  GoalSide goal_;
  KeeperLine line_;
  std::optional<KeeperMind> mind_;
  DriveLimits limits_;
  std::optional<Chassis> chassis_;  ///< drive to a ball, if it comes out
  std::optional<ComingOut> out_;
  BallTrack track_;
  std::deque<Sight> coming_;  ///< sightings that are not known yet because of the delay
  Timestamp newest_ = -1;     ///< stamp of the newest sighting
};

struct GoalkeeperHelp : PlayerHelp {
  explicit GoalkeeperHelp(const Parameters&)
      : PlayerHelp(
            "keeps a goal as goalkeeper did when it was frozen",
            {{"policy", "still|random|pattern|blocking|intercepting|mixed", "intercepting",
              "how it moves along its line"},
             kSeesOption,
             {"speed_m_s", "m/s", "1.5", "how fast it drives at most"},
             {"delay_s", "s", "0", "delay of its sight"},
             {"noise_m", "m", "0", "standard deviation of where it sees the ball"},
             {"period_s", "s", "0.04", "time between two decisions"},
             {"line_m", "m", "0.5", "distance of its line from the goal line"},
             {"reach_m", "m", "0.75", "how far it goes to either side of the goal's middle"},
             {"slack_m", "m", "0", "distance from its line beyond which it steers back"},
             {"braking_m_s2", "m/s^2", "0.2943", "deceleration of a rolling ball that it assumes"},
             {"comes_out_m", "m", "0",
              "distance from its goal within which it leaves its line for a slow ball"},
             kWheelAnglesOption,
             kWheelDistanceOption}) {}
};

}  // namespace
}  // namespace ortung

ORTUNG_PLUGINS("goalkeeper-v1",
               ortung::provide<ortung::Player, ortung::GoalkeeperPlayer>("goalkeeper-v1"),
               ortung::provide<ortung::PlayerHelp, ortung::GoalkeeperHelp>("goalkeeper-v1"));

#include "FootballWatch.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "Contact.hpp"
#include "ortung/sim_api/Referee.hpp"

namespace ortung {
namespace {

constexpr double kTouch = 0.02;   ///< greatest gap between a ball and who touches it [m]
constexpr double kMoves = 0.1;    ///< least speed of a robot that goes somewhere [m/s]
constexpr double kAt = 1.0;       ///< distance from the ball at which it goes around it [m]
constexpr double kTowards = 0.5;  ///< least cosine between its way and that to the ball
constexpr double kStill = 0.15;   ///< radius of the circle that a standing robot does not leave [m]
constexpr double kPass = 1.0;     ///< least way of the ball in a pass [m]
constexpr double kBraking = 0.2943;  ///< deceleration of a rolling ball [m/s^2]
constexpr double kAhead = 1.0;       ///< time for which a rolling ball is foreseen [s]
constexpr Timestamp kOwn =
    2'000'000;                     ///< an own goal is one without the other team for so long [us]
constexpr double kFarthest = 1.5;  ///< bodies are not looked at beyond this distance [m]

/// Returns whether somebody who moves like this goes to a place.
bool goesTo(const RobotState& robot, double x, double y) {
  const double speed = std::hypot(robot.velocity.x, robot.velocity.y);
  const double dx = x - robot.pose.x;
  const double dy = y - robot.pose.y;
  const double away = std::hypot(dx, dy);
  return speed >= kMoves &&
         (away < kAt || dx * robot.velocity.x + dy * robot.velocity.y >= kTowards * speed * away);
}

/// Returns whether a robot goes for the ball where it is, or where it will be.
bool goesFor(const RobotState& robot, const Simulation::Thing& ball) {
  if (goesTo(robot, ball.pose.x, ball.pose.y)) return true;
  const double v = std::hypot(ball.velocity.x, ball.velocity.y);
  if (v <= 0.0) return false;
  const double t = std::min(kAhead, v / kBraking);
  const double share = t - 0.5 * kBraking * t * t / v;
  return goesTo(robot, ball.pose.x + share * ball.velocity.x,
                ball.pose.y + share * ball.velocity.y);
}

}  // namespace

FootballWatch::FootballWatch(SceneRun& run, std::string first,
                             const std::vector<std::string>& keepers)
    : run_(run), first_(std::move(first)) {
  for (const auto& robot : run.simulation().robots()) {
    const std::string& name = robot->config().name;
    const bool isKeeper = std::find(keepers.begin(), keepers.end(), name) != keepers.end();
    stands_.push_back({name, teamOf(run.players().teamOf(name)), isKeeper});
  }
}

void FootballWatch::compare() {
  const auto robots = run_.simulation().robots();
  for (std::size_t i = 0; i < stands_.size(); ++i)
    errors_[stands_[i].team].add(run_.players().believedPose(*robots[i]), robots[i]->state().pose,
                                 now());
}

/// Begins anew when play does: the referee may have carried everybody elsewhere.
void FootballWatch::forget() {
  last_.reset();
  lastOf_ = {};
  aloneSince_.reset();
  for (Stand& stand : stands_) stand.anchor.reset();
}

void FootballWatch::take(const RefereeEvent& event) {
  if (event.what == "ball-stuck") ++half_.stuck;
  if (event.what == "set-piece-over") ++half_.late;
  if (event.what != "goal") return;
  const std::size_t scoring = teamOf(event.team);
  ++half_.goals[scoring];
  const bool isOwn = last_ && last_->team != scoring &&
                     (!lastOf_[scoring] || event.stamp - *lastOf_[scoring] > kOwn);
  if (isOwn) ++half_.ownGoals[1 - scoring];
}

void FootballWatch::touched(const Stand& stand, const Pose2& ball) {
  if (last_ && last_->robot != stand.robot && last_->team == stand.team &&
      distance(last_->ball, ball) >= kPass)
    ++half_.passes[stand.team];
  last_ = {stand.robot, stand.team, ball};
  lastOf_[stand.team] = now();
}

/// Returns whether somebody touches the ball or goes for it.
bool FootballWatch::lookAtTouches(const Simulation::Thing& ball) {
  const double rolled = std::hypot(ball.velocity.x, ball.velocity.y) * run_.simulation().cycle();
  const double reach = GoalField::kBall + kTouch + rolled;
  const auto robots = run_.simulation().robots();
  bool isAttended = false;
  double nearest = reach;
  const Stand* toucher = nullptr;
  for (std::size_t i = 0; i < stands_.size(); ++i) {
    const bool isNear = distance(robots[i]->state().pose, ball.pose) < kFarthest;
    const double gap = isNear ? distanceToPieces(*robots[i], ball) : kFarthest;
    stands_[i].touches = gap < reach;
    isAttended = isAttended || stands_[i].touches || goesFor(robots[i]->state(), ball);
    if (gap < nearest) nearest = gap, toucher = &stands_[i];
  }
  if (toucher != nullptr) touched(*toucher, ball.pose);
  return isAttended;
}

void FootballWatch::lookAtStands(const Pose2& ball) {
  const auto robots = run_.simulation().robots();
  std::array<Stand*, 2> who{};
  std::array<double, 2> nearest{};
  for (std::size_t i = 0; i < stands_.size(); ++i) {
    Stand& stand = stands_[i];
    const double away = distance(robots[i]->state().pose, ball);
    if (stand.isKeeper || (who[stand.team] != nullptr && away >= nearest[stand.team])) continue;
    nearest[stand.team] = away;
    who[stand.team] = &stand;
  }
  for (std::size_t i = 0; i < stands_.size(); ++i)
    countStand(stands_[i], robots[i]->state().pose,
               who[stands_[i].team] == &stands_[i] && !stands_[i].touches);
}

void FootballWatch::countStand(Stand& stand, const Pose2& at, bool isNearest) {
  if (!stand.anchor || distance(at, *stand.anchor) > kStill) {
    stand.anchor = at;
    stand.since = now();
    stand.isIdle = false;
  }
  if (isNearest && !stand.isIdle) stand.idle = now();
  stand.isIdle = isNearest;
  if (stand.isKeeper) return;
  half_.longestStand = std::max(half_.longestStand, now() - stand.since);
  if (isNearest) half_.longestIdle = std::max(half_.longestIdle, now() - stand.idle);
}

void FootballWatch::look(std::span<const RefereeEvent> events) {
  for (const RefereeEvent& event : events) take(event);
  const auto things = run_.simulation().things();
  const auto ball = std::find_if(things.begin(), things.end(),
                                 [](const auto& thing) { return thing.kind == "ball"; });
  const Game::Phase phase = run_.game().phase;
  const bool isPlaying = phase == Game::Phase::kPlaying && ball != things.end();
  if (phase == Game::Phase::kStopped || (isPlaying && !wasPlaying_)) forget();
  wasPlaying_ = isPlaying;
  if (!isPlaying) return;
  const Timestamp cycle = fromSeconds(run_.simulation().cycle());
  half_.inPlay += cycle;
  const bool isAttended = lookAtTouches(*ball);
  lookAtStands(ball->pose);
  if (isAttended) return aloneSince_.reset();
  if (!aloneSince_) aloneSince_ = now() - cycle;
  half_.unattended += cycle;
  half_.longestAlone = std::max(half_.longestAlone, now() - *aloneSince_);
}

FootballHalf FootballWatch::half() const {
  FootballHalf half = half_;
  half.pose = {errors_[0].mean(), errors_[1].mean()};
  PoseDigest digest;
  for (const auto& thing : run_.simulation().things()) digest.add(thing.pose);
  for (const auto& robot : run_.simulation().robots()) digest.add(robot->state().pose);
  half.digest = digest.value();
  return half;
}

}  // namespace ortung

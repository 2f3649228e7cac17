#include "Match.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

#include "Formation.hpp"
#include "Placing.hpp"

namespace ortung::soccer {
namespace {

constexpr std::size_t kMostEvents = 10000;  ///< greatest number of events that wait to be taken

std::string told(double x, double y) {
  char text[64];
  std::snprintf(text, sizeof text, "(%.2f, %.2f)", x, y);
  return text;
}

}  // namespace

Match::Match(Config config)
    : config_(std::move(config)),
      clock_(config_.rules.match),
      touches_(config_.rules.ball.touchMargin),
      ballOut_(config_.rules.out, config_.rules.goal),
      stuck_(config_.rules.stuck),
      areas_(config_.rules.areas) {
  reset();
}

const Game& Match::watch(Stage& stage) {
  if (!pitch_) pitch_ = Pitch::of(stage.world(), config_.rules.pitch);
  scene_ = Scene::of(stage, game_, config_.rules.ball.radius);
  const double elapsed = last_ ? std::max(toSeconds(scene_.now - *last_), 0.0) : 0.0;
  last_ = scene_.now;
  countTime(elapsed);
  const std::vector<Order> orders = std::exchange(orders_, {});
  for (const Order& order : orders) obey(stage, order);
  if (game_.phase == Game::Phase::kOver && isPause_) beginNextMatch();
  const bool isSomebodyThere =
      std::any_of(scene_.robots.begin(), scene_.robots.end(), [](const auto& r) { return r.team; });
  if (clock_.half() == 0 && config_.control == Control::kRules && !waits_ && isSomebodyThere)
    beginHalf(stage, 1);
  if (game_.phase == Game::Phase::kStopped) {
    whileStopped(stage);
  } else if (game_.phase == Game::Phase::kReady) {
    whileReady(stage);
  } else if (game_.phase == Game::Phase::kPlaying) {
    whilePlaying(stage);
  }
  game_.half = clock_.half();
  game_.clock = clock_.time();
  return game_;
}

std::vector<RefereeEvent> Match::takeEvents() { return std::exchange(events_, {}); }

bool Match::holds(std::string_view robot) const {
  const Scene::Robot* found = scene_.find(robot);
  return found != nullptr && !game_.mayPlay(nameOfTeam(found->team));
}

void Match::countTime(double elapsed) {
  const bool isPlayed = game_.phase == Game::Phase::kPlaying;
  if (clock_.half() == 0 || isPause_ || game_.phase == Game::Phase::kOver) return;
  if (clock_.stopsWithBall() && !isPlayed) return;
  clock_.advance(elapsed);
  if (config_.control == Control::kRules && clock_.isHalfOver()) endHalf();
}

void Match::endHalf() {
  const bool isDraw = game_.teams[0].score == game_.teams[1].score;
  if (!clock_.hasNext(isDraw)) {
    endGame();
    isPause_ = config_.matches == 0 || match_ < config_.matches;
    since_ = scene_.now;
    return;
  }
  game_.phase = Game::Phase::kStopped;
  restart_.reset();
  isPause_ = true;
  since_ = scene_.now;
  tell("half-time", std::nullopt, "half " + std::to_string(clock_.half()) + " is over");
}

void Match::endGame() {
  game_.phase = Game::Phase::kOver;
  restart_.reset();
  isPause_ = false;
  tell("end", std::nullopt,
       "the game is over: " + game_.teams[0].name + " " + std::to_string(game_.teams[0].score) +
           ", " + game_.teams[1].name + " " + std::to_string(game_.teams[1].score));
}

/// Begins the next match after the pause, with a reset state.
void Match::beginNextMatch() {
  if (toSeconds(scene_.now - since_) < config_.rules.match.pause) return;
  reset();
  ++match_;
  tell("match", std::nullopt, "match " + std::to_string(match_) + " begins");
}

void Match::whileStopped(Stage& stage) {
  if (isPause_) {
    const bool isOver = toSeconds(scene_.now - since_) >= config_.rules.match.pause;
    if (isOver && !waits_ && config_.control == Control::kRules)
      beginHalf(stage, clock_.half() + 1);
    return;
  }
  if (!restart_) return;
  if (hasNewcomer()) place(stage);
  if (!waits_ && toSeconds(scene_.now - since_) >= config_.rules.restart.placing) begin(stage);
}

void Match::whileReady(Stage&) {
  touches_.look(scene_);
  const FloorPoint ball = ballPlace();
  const double moved = std::hypot(ball.x - restart_->place.x, ball.y - restart_->place.y);
  if (scene_.ball && moved > config_.rules.restart.inPlay) {
    tell("play", restart_->team, "the ball is in play");
    return play();
  }
  if (toSeconds(scene_.now - since_) < config_.rules.restart.setPiece) return;
  tell("set-piece-over", restart_->team,
       nameOfTeam(restart_->team) + " has not taken it in time, all robots may play");
  play();
}

void Match::whilePlaying(Stage& stage) {
  if (!scene_.ball) return;
  touches_.look(scene_);
  if (config_.control == Control::kOrders) return;
  if (const auto leaving = ballOut_.look(*scene_.ball, *pitch_)) return leave(stage, *leaving);
  if (const auto foul = areas_.look(scene_, *pitch_, game_)) {
    tell("foul", foul->team, foul->text);
    return giveAt(stage, config_.rules.areas.restart, 1 - foul->team, foul->place, foul->text);
  }
  if (stuck_.look(*scene_.ball, scene_.now)) {
    tell("ball-stuck", std::nullopt,
         "the ball is stuck at " + told(scene_.ball->x, scene_.ball->y));
    giveAt(stage, Game::Restart::kDroppedBall, std::nullopt, ballPlace(), "the ball was stuck");
  }
}

void Match::leave(Stage& stage, const Leaving& leaving) {
  if (leaving.over == Leaving::Over::kIntoGoal) return judgeGoal(stage, leaving);
  const bool overTouchLine = leaving.over == Leaving::Over::kTouchLine;
  const std::string why = std::string("the ball left over the ") +
                          (overTouchLine ? "touch line" : "goal line") + " at " +
                          told(leaving.x, leaving.y) + ", last touched by " +
                          (touches_.lastTeam() ? touches_.lastRobot() : "no robot");
  const bool isRestart = overTouchLine ? config_.rules.out.hasThrowIn : config_.rules.out.hasKicks;
  if (isRestart)
    return give(stage,
                restartAfter(leaving, touches_.lastTeam(), *pitch_, config_.rules.places, game_),
                why);
  tell("ball-out", touches_.lastTeam(), why);
  const FloorPoint at = putBack(leaving, *pitch_, config_.rules.out.putBack);
  for (const std::string& problem : Placing(stage, scene_, *pitch_).placeBall(at))
    tell("problem", std::nullopt, problem);
  ballOut_.reset();
  touches_.jump();
}

void Match::judgeGoal(Stage& stage, const Leaving& leaving) {
  const std::size_t conceding = defenderOf(leaving.x, game_);
  const std::size_t scoring = 1 - conceding;
  const Rules::Goal& rules = config_.rules.goal;
  const FloorPoint at{leaving.x, leaving.y};
  const bool isDirect =
      touches_.robots() < 2 && game_.restart != Game::Restart::kNone &&
      std::find(rules.direct.begin(), rules.direct.end(), game_.restart) == rules.direct.end();
  if (isDirect && touches_.robots() > 0) {
    const std::string why = "no goal: only " + touches_.lastRobot() +
                            " has touched the ball since the " + std::string(nameOf(game_.restart));
    tell("no-goal", scoring, why);
    const bool isOwn = touches_.lastTeam() == conceding;
    return isOwn ? giveAt(stage, Game::Restart::kCorner, scoring, at, why)
                 : giveAt(stage, Game::Restart::kGoalKick, conceding, at, why);
  }
  const double forward = game_.directionOf(game_.teams[scoring].name);
  if (!rules.fromOwnHalf && touches_.lastTeam() == scoring &&
      forward * touches_.lastPlace().x < 0.0) {
    const std::string why = "no goal: it was shot from the own half";
    tell("no-goal", scoring, why);
    return giveAt(stage, Game::Restart::kGoalKick, conceding, at, why);
  }
  ++game_.teams[scoring].score;
  const std::string by = touches_.lastTeam() ? " by " + touches_.lastRobot() : "";
  tell("goal", scoring,
       "goal" + by + ": " + game_.teams[0].name + " " + std::to_string(game_.teams[0].score) +
           ", " + game_.teams[1].name + " " + std::to_string(game_.teams[1].score));
  giveAt(stage, Game::Restart::kKickOff, conceding, {}, "after a goal");
}

void Match::giveAt(Stage& stage, Game::Restart kind, std::optional<std::size_t> team,
                   const FloorPoint& at, const std::string& why) {
  give(stage, restartAt(kind, team, at, *pitch_, config_.rules.places, game_), why);
}

void Match::give(Stage& stage, const Restart& restart, const std::string& why) {
  restart_ = restart;
  game_.phase = Game::Phase::kStopped;
  game_.restart = restart.kind;
  game_.restartOf = restart.team;
  waits_ = config_.control == Control::kOrders;
  isPause_ = false;
  since_ = scene_.now;
  tell(std::string(nameOf(restart.kind)), restart.team, why);
  place(stage);
}

void Match::place(Stage& stage) {
  Placing placing(stage, scene_, *pitch_);
  const auto wishes = formation(scene_, *restart_, *pitch_, config_.rules, game_);
  for (const std::string& problem : placing.place(wishes, *restart_))
    tell("problem", std::nullopt, problem);
  placed_.clear();
  for (const Scene::Robot& robot : scene_.robots) placed_.push_back(robot.name);
  scene_ = Scene::of(stage, game_, config_.rules.ball.radius);
  forgetPlay();
}

bool Match::hasNewcomer() const {
  return std::any_of(scene_.robots.begin(), scene_.robots.end(), [this](const auto& robot) {
    return robot.team && std::find(placed_.begin(), placed_.end(), robot.name) == placed_.end();
  });
}

/// Places everything and gives the restart.
void Match::begin(Stage& stage) {
  waits_ = false;
  since_ = scene_.now;
  place(stage);                                    // robots may have rolled on, and the ball
  if (scene_.ball) restart_->place = ballPlace();  // aside, for want of room
  if (!restart_->team) return play();
  game_.phase = Game::Phase::kReady;
}

void Match::play() {
  game_.phase = Game::Phase::kPlaying;
  restart_.reset();
  waits_ = false;
  since_ = scene_.now;
}

void Match::forgetPlay() {
  touches_.reset();
  ballOut_.reset();
  stuck_.reset();
  areas_.reset();
}

FloorPoint Match::ballPlace() const {
  return scene_.ball ? FloorPoint{scene_.ball->x, scene_.ball->y} : FloorPoint{};
}

std::string Match::nameOfTeam(std::optional<std::size_t> team) const {
  return team ? game_.teams[*team].name : "";
}

void Match::tell(const std::string& what, std::optional<std::size_t> team,
                 const std::string& text) {
  if (events_.size() >= kMostEvents) events_.erase(events_.begin());
  events_.push_back({scene_.now, what, nameOfTeam(team), text});
}

}  // namespace ortung::soccer

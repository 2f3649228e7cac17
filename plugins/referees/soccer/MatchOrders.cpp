// The effects of orders: a part of Match.
#include <algorithm>
#include <stdexcept>
#include <utility>

#include "Match.hpp"

namespace ortung::soccer {

void Match::order(std::string_view text) {
  constexpr std::size_t kMost = 1000;
  Order order = orderOf(text, game_);
  if (orders_.size() >= kMost)
    throw std::invalid_argument("too many orders wait for the next cycle");
  orders_.push_back(std::move(order));
}

void Match::obey(Stage& stage, const Order& order) {
  if (game_.phase == Game::Phase::kOver && order.kind != Order::Kind::kReset &&
      order.kind != Order::Kind::kBeginHalf && order.kind != Order::Kind::kNote) {
    return tell("ignored", order.team, "the game is over: '" + order.text + "' has no effect");
  }
  switch (order.kind) {
    case Order::Kind::kStart:
      return start(stage);
    case Order::Kind::kStop:
      game_.phase = Game::Phase::kStopped;
      waits_ = true;
      return tell("stop", std::nullopt, "stopped by order");
    case Order::Kind::kRestart:
      if (clock_.half() == 0) clock_.begin(1);
      return giveAt(stage, order.restart, order.team, ballPlace(), "by order");
    case Order::Kind::kGoal:
      ++game_.teams[*order.team].score;
      tell("goal", order.team, "by order");
      if (config_.control == Control::kOrders) return;
      return giveAt(stage, Game::Restart::kKickOff, 1 - *order.team, {}, "after a goal");
    case Order::Kind::kNoGoal:
      game_.teams[*order.team].score = std::max(game_.teams[*order.team].score - 1, 0);
      return tell("no-goal", order.team, "a goal is cancelled by order");
    case Order::Kind::kHalfTime:
      return endHalf();
    case Order::Kind::kBeginHalf:
      return beginHalf(stage, order.half + (order.isOvertime ? config_.rules.match.halves : 0));
    case Order::Kind::kEnd:
      return endGame();
    case Order::Kind::kReset:
      reset();
      return tell("reset", std::nullopt, "by order");
    case Order::Kind::kNote:
      return tell(order.text, order.team, "by order");
  }
}

void Match::start(Stage& stage) {
  if (game_.phase != Game::Phase::kStopped) return;
  tell("start", std::nullopt, "started by order");
  if (isPause_) return beginHalf(stage, clock_.half() + 1);
  if (clock_.half() == 0) return beginHalf(stage, 1);
  if (restart_) return begin(stage);
  forgetPlay();
  play();
}

void Match::beginHalf(Stage& stage, int half) {
  clock_.begin(half);
  isPause_ = false;
  waits_ = false;
  game_.phase = Game::Phase::kStopped;
  restart_.reset();
  const auto number = static_cast<std::size_t>(std::max(half - 1, 0));
  if (config_.rules.match.sidesChange) game_.teamOnTheLeft = (config_.left + number) % 2;
  tell("half", std::nullopt,
       "half " + std::to_string(half) + " begins, " + game_.teams[game_.teamOnTheLeft].name +
           " on the left");
  if (config_.control == Control::kRules)
    giveAt(stage, Game::Restart::kKickOff, (config_.kickOff + number) % 2, {}, "a half begins");
}

/// Resets the game to the state before the first half.
void Match::reset() {
  game_ = {};
  for (std::size_t i = 0; i < 2; ++i) game_.teams[i].name = config_.teams[i];
  game_.teamOnTheLeft = config_.left;
  game_.phase = Game::Phase::kStopped;
  clock_ = MatchClock(config_.rules.match);
  restart_.reset();
  waits_ = false;
  isPause_ = false;
  forgetPlay();
}

}  // namespace ortung::soccer

#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "ortung/sim_api/Game.hpp"

namespace ortung::soccer {

/// What a person or a referee box may order.
struct Order {
  enum class Kind {
    kStart,
    kStop,
    kRestart,  ///< of a kind
    kGoal,
    kNoGoal,
    kHalfTime,
    kBeginHalf,
    kEnd,
    kReset,
    kNote  ///< without consequences: cards, repairs
  };
  Kind kind = Kind::kStop;
  Game::Restart restart = Game::Restart::kNone;
  int half = 0;                     ///< of kBeginHalf; within overtime from 1
  bool isOvertime = false;          ///< of kBeginHalf
  std::optional<std::size_t> team;  ///< nothing: none is named
  std::string text;                 ///< as it was given
};

/// @throws std::invalid_argument for a text that is no order, with those that there are
Order orderOf(std::string_view text, const Game& game);

}  // namespace ortung::soccer

#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "ortung/sim_api/Game.hpp"

namespace ortung::soccer {

/// An order of a person or of a referee box.
struct Order {
  enum class Kind {
    kStart,
    kStop,
    kRestart,  ///< a restart of the kind in `restart`
    kGoal,
    kNoGoal,
    kHalfTime,
    kBeginHalf,
    kEnd,
    kReset,
    kNote  ///< a note without consequences: cards, repairs
  };
  Kind kind = Kind::kStop;
  Game::Restart restart = Game::Restart::kNone;
  int half = 0;                     ///< the half of kBeginHalf; within overtime counted from 1
  bool isOvertime = false;          ///< whether the half of kBeginHalf is one of overtime
  std::optional<std::size_t> team;  ///< index of the team; nothing: none is named
  std::string text;                 ///< the order as it was given
};

/// Reads an order. @throws std::invalid_argument for an unknown order, with a list of known ones
Order orderOf(std::string_view text, const Game& game);

}  // namespace ortung::soccer

#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "ortung/base/Export.hpp"

namespace ortung {

/// The state of the game that a referee announces to all: whether the ball is in play, which
/// restart is next, time and score. Without a referee all robots play freely.
struct ORTUNG_API Game {
  enum class Phase {
    kFree,     ///< there is no referee
    kStopped,  ///< all robots are held; the referee may place robots and the ball
    kReady,    ///< a restart was awarded: its team may take it, the other keeps its distance
    kPlaying,  ///< the ball is in play
    kOver      ///< the match is over
  };
  enum class Restart {
    kNone,
    kKickOff,
    kThrowIn,
    kGoalKick,
    kCorner,
    kFreeKick,
    kPenalty,
    kDroppedBall  ///< the ball is dropped for both teams
  };
  /// A team, which is named after its colour, and its goals.
  struct Team {
    std::string name;
    int score = 0;
  };

  Phase phase = Phase::kFree;
  Restart restart = Restart::kNone;  ///< the next restart, or the last one
  /// Index of the team that takes it; nothing: both teams or none.
  std::optional<std::size_t> restartOf;
  std::array<Team, 2> teams = {Team{"blue"}, Team{"yellow"}};
  std::size_t teamOnTheLeft = 0;  ///< index of the team that defends the goal at negative x
  int half = 0;                   ///< the current half, from 1; 0: the match has not begun
  double clock = 0.0;             ///< time since the half began [s]

  /// Returns the index of a team, 0 or 1; nothing if it does not take part.
  std::optional<std::size_t> find(std::string_view team) const;
  /// Returns the direction in which a team plays: 1 towards positive x, -1 towards negative x; 1
  /// for a team that does not take part.
  double directionOf(std::string_view team) const;
  /// Returns whether robots of this team may drive and kick now.
  bool mayPlay(std::string_view team) const;

  bool operator==(const Game&) const = default;
};
inline bool operator==(const Game::Team& a, const Game::Team& b) {
  return a.name == b.name && a.score == b.score;
}

/// Return "playing", "kick-off", ...: the words of messages, files and the protocol.
ORTUNG_API std::string_view nameOf(Game::Phase phase);
ORTUNG_API std::string_view nameOf(Game::Restart restart);
/// Writes a game as one line: "phase=ready restart=kick-off restart_of=blue half=1 clock_s=12.5
/// blue=0 yellow=1 left=blue".
ORTUNG_API std::string toText(const Game& game);
/// Reads what toText() has written. @throws std::invalid_argument for any other text
ORTUNG_API Game gameIn(std::string_view text);
/// Return the phase or restart of this name; nothing if there is none.
ORTUNG_API std::optional<Game::Phase> phaseOf(std::string_view name);
ORTUNG_API std::optional<Game::Restart> restartOf(std::string_view name);

}  // namespace ortung

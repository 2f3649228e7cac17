#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "ortung/base/Export.hpp"

namespace ortung {

/// What a referee tells everybody: whether the ball is in play, what comes next, time and score.
/// Where there is no referee, everybody plays as he likes.
struct ORTUNG_API Game {
  enum class Phase {
    kFree,     ///< nobody referees
    kStopped,  ///< all stand, the referee may place robots and ball
    kReady,    ///< a restart was given: who has it may take it, the others keep away
    kPlaying,
    kOver
  };
  enum class Restart {
    kNone,
    kKickOff,
    kThrowIn,
    kGoalKick,
    kCorner,
    kFreeKick,
    kPenalty,
    kDroppedBall  ///< for both teams
  };
  /// A team is called by its colour.
  struct Team {
    std::string name;
    int score = 0;
  };

  Phase phase = Phase::kFree;
  Restart restart = Restart::kNone;      ///< what comes, or what was last
  std::optional<std::size_t> restartOf;  ///< place among the teams; nothing: of both, or of nobody
  std::array<Team, 2> teams = {Team{"blue"}, Team{"yellow"}};
  std::size_t teamOnTheLeft = 0;  ///< defends the goal at negative x
  int half = 0;                   ///< from 1; 0: it has not begun
  double clock = 0.0;             ///< of this half [s]

  /// Place of a team among the two, or nothing.
  std::optional<std::size_t> find(std::string_view team) const;
  /// Direction in which a team plays: 1 towards positive x, -1 towards negative; of a team that
  /// does not take part, 1.
  double directionOf(std::string_view team) const;
  /// Whether a robot of this team may drive and kick now.
  bool mayPlay(std::string_view team) const;

  bool operator==(const Game&) const = default;
};
inline bool operator==(const Game::Team& a, const Game::Team& b) {
  return a.name == b.name && a.score == b.score;
}

/// "playing", "kick-off": words of messages, files and the protocol.
ORTUNG_API std::string_view nameOf(Game::Phase phase);
ORTUNG_API std::string_view nameOf(Game::Restart restart);
/// "phase=ready restart=kick-off restart_of=blue half=1 clock_s=12.5 blue=0 yellow=1 left=blue".
ORTUNG_API std::string toText(const Game& game);
/// What toText() has written. @throws std::invalid_argument for what is no such text
ORTUNG_API Game gameIn(std::string_view text);
/// Nothing if there is none of this name.
ORTUNG_API std::optional<Game::Phase> phaseOf(std::string_view name);
ORTUNG_API std::optional<Game::Restart> restartOf(std::string_view name);

}  // namespace ortung

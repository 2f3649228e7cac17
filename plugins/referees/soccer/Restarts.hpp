#pragma once

#include <optional>

#include "BallOut.hpp"
#include "Pitch.hpp"
#include "ortung/sim_api/Game.hpp"

namespace ortung::soccer {

/// A restart: its kind, its team, and the place of the ball.
struct Restart {
  Game::Restart kind = Game::Restart::kNone;
  std::optional<std::size_t> team;  ///< index of its team; nothing: both
  FloorPoint place;                 ///< place of the ball [m]
};

/// Returns the restart of a kind, at the place that the rules say. @param at place of the event: of
/// the ball or of a foul
Restart restartAt(Game::Restart kind, std::optional<std::size_t> team, const FloorPoint& at,
                  const Pitch& pitch, const Rules::Places& places, const Game& game);

/// Returns the restart after the ball has left the pitch, not into a goal: throw-in, corner, goal
/// kick. @param last team that touched it last; nothing: the restart is for the team that defends
/// that half
Restart restartAfter(const Leaving& leaving, std::optional<std::size_t> last, const Pitch& pitch,
                     const Rules::Places& places, const Game& game);

/// Returns the place where the ball is put back without a restart: inside the line that it has
/// crossed [m].
FloorPoint putBack(const Leaving& leaving, const Pitch& pitch, double inside);

/// Returns the team that defends the goal at that end of x.
std::size_t defenderOf(double x, const Game& game);

}  // namespace ortung::soccer

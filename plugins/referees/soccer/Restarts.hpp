#pragma once

#include <optional>

#include "BallOut.hpp"
#include "Pitch.hpp"
#include "ortung/sim_api/Game.hpp"

namespace ortung::soccer {

/// How play goes on: what is given to whom, and where the ball lies.
struct Restart {
  Game::Restart kind = Game::Restart::kNone;
  std::optional<std::size_t> team;  ///< nothing: of both
  FloorPoint place;                 ///< [m]
};

/// The restart of a kind, by the rules' places. @param at where it happened: the ball was there, a
/// foul was made there
Restart restartAt(Game::Restart kind, std::optional<std::size_t> team, const FloorPoint& at,
                  const Pitch& pitch, const Rules::Places& places, const Game& game);

/// Who goes on with what after the ball has left the pitch, not into a goal: throw-in, corner, goal
/// kick. @param last who touched it last; nothing: it is the ball of whoever defends that half
Restart restartAfter(const Leaving& leaving, std::optional<std::size_t> last, const Pitch& pitch,
                     const Rules::Places& places, const Game& game);

/// Where the ball comes back without a restart: inside the line that it has crossed. [m]
FloorPoint putBack(const Leaving& leaving, const Pitch& pitch, double inside);

/// The team that defends the goal at that end of x.
std::size_t defenderOf(double x, const Game& game);

}  // namespace ortung::soccer

#pragma once

#include <vector>

#include "Pitch.hpp"
#include "Restarts.hpp"
#include "Rules.hpp"
#include "Scene.hpp"

namespace ortung::soccer {

/// The wanted pose of a robot at a restart, and the conditions for any pose that it gets.
struct Wish {
  std::size_t robot = 0;   ///< index in the scene
  Pose2 pose;              ///< wanted pose; its current one if it may stay
  double keepAway = 0.0;   ///< least gap between its edge and the ball's [m]
  double direction = 1.0;  ///< direction in which its team plays, 1 or -1
  bool inOwnHalf = false;  ///< whether its whole body must be in its own half
  /// Whether it must be outside of the penalty area with the ball, and behind the ball.
  bool behindPenalty = false;
};

/// Returns the wishes for all robots that take part, in the order of the scene.
std::vector<Wish> formation(const Scene& scene, const Restart& restart, const Pitch& pitch,
                            const Rules& rules, const Game& game);

}  // namespace ortung::soccer

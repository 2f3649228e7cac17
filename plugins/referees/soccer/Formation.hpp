#pragma once

#include <vector>

#include "Pitch.hpp"
#include "Restarts.hpp"
#include "Rules.hpp"
#include "Scene.hpp"

namespace ortung::soccer {

/// Where a robot is to stand at a restart, and what holds wherever it stands.
struct Wish {
  std::size_t robot = 0;       ///< place in the scene
  Pose2 pose;                  ///< where it is, if it may stay
  double keepAway = 0.0;       ///< gap between its edge and the ball's [m]
  double direction = 1.0;      ///< in which its team plays
  bool inOwnHalf = false;      ///< with all of its body
  bool behindPenalty = false;  ///< outside the penalty area where the ball is, and behind the ball
};

/// For all robots that take part, in the order of the scene.
std::vector<Wish> formation(const Scene& scene, const Restart& restart, const Pitch& pitch,
                            const Rules& rules, const Game& game);

}  // namespace ortung::soccer

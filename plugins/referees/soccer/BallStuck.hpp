#pragma once

#include <optional>

#include "Rules.hpp"
#include "Scene.hpp"

namespace ortung::soccer {

/// Detects that the ball has stayed within a small circle for too long.
class BallStuck {
 public:
  explicit BallStuck(const Rules::Stuck& rules) : rules_(rules) {}

  /// Observes a cycle; to be called once per cycle of play. @returns whether the ball is stuck
  bool look(const Scene::Ball& ball, Timestamp now);
  void reset() { anchor_.reset(); }

 private:
  Rules::Stuck rules_;
  std::optional<FloorPoint> anchor_;
  Timestamp since_ = 0;
};

}  // namespace ortung::soccer

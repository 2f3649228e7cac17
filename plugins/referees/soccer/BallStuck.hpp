#pragma once

#include <optional>

#include "Rules.hpp"
#include "Scene.hpp"

namespace ortung::soccer {

/// Sees that the ball has stayed within a small circle for too long.
class BallStuck {
 public:
  explicit BallStuck(const Rules::Stuck& rules) : rules_(rules) {}

  /// Once a cycle of play.
  bool look(const Scene::Ball& ball, Timestamp now);
  void reset() { anchor_.reset(); }

 private:
  Rules::Stuck rules_;
  std::optional<FloorPoint> anchor_;
  Timestamp since_ = 0;
};

}  // namespace ortung::soccer

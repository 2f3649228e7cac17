#pragma once

#include <optional>

#include "Pitch.hpp"
#include "Scene.hpp"

namespace ortung::soccer {

/// The way in which the ball has left the pitch.
struct Leaving {
  enum class Over { kTouchLine, kGoalLine, kIntoGoal };
  Over over = Over::kTouchLine;
  double x = 0.0;  ///< x where its middle crossed the line's outer edge [m]
  double y = 0.0;
};

/// Detects that the ball leaves the pitch: over a touch line, over a goal line, or into a goal. The
/// place of crossing is interpolated between two cycles, so that fast balls are judged at the line.
class BallOut {
 public:
  BallOut(const Rules::Out& out, const Rules::Goal& goal) : out_(out), goal_(goal) {}

  std::optional<Leaving> look(const Scene::Ball& ball, const Pitch& pitch);
  /// Forgets the ball's last place, after it was moved.
  void reset() { before_.reset(); }

 private:
  Rules::Out out_;
  Rules::Goal goal_;
  std::optional<FloorPoint> before_;
};

}  // namespace ortung::soccer

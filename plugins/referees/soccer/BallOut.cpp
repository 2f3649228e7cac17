#include "BallOut.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace ortung::soccer {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();

/// Returns the share of the path from a to b at which |value| exceeds the bound; 0 if it did
/// before.
double shareAt(double a, double b, double bound) {
  if (!(std::abs(b) > bound)) return kNever;
  if (std::abs(a) > bound) return 0.0;
  const double end = b > 0.0 ? bound : -bound;
  return (end - a) / (b - a);
}

double between(double a, double b, double share) { return a + (b - a) * share; }

}  // namespace

std::optional<Leaving> BallOut::look(const Scene::Ball& ball, const Pitch& pitch) {
  const FloorPoint to{ball.x, ball.y};
  const FloorPoint from = before_.value_or(to);
  before_ = to;
  const double goalAt = pitch.halfLength + (goal_.wholeBall ? ball.radius : 0.0);
  const double beyond = (out_.wholeBall ? ball.radius : 0.0) + out_.margin;
  const double intoGoal = shareAt(from.x, to.x, goalAt);
  // A ball in the mouth of the goal is not out, whatever the margins are.
  if (intoGoal <= 1.0) {
    const double y = between(from.y, to.y, intoGoal);
    if (std::abs(y) < pitch.halfGoal)
      return Leaving{Leaving::Over::kIntoGoal, std::copysign(pitch.halfLength, to.x), y};
  }
  const double overGoalLine = shareAt(from.x, to.x, pitch.halfLength + beyond);
  const double overTouchLine = shareAt(from.y, to.y, pitch.halfWidth + beyond);
  const bool isInMouth =
      std::abs(to.y) < pitch.halfGoal && std::abs(from.y) < pitch.halfGoal && !(intoGoal <= 1.0);
  if (overTouchLine <= 1.0 && overTouchLine <= overGoalLine) {
    const double x =
        std::clamp(between(from.x, to.x, overTouchLine), -pitch.halfLength, pitch.halfLength);
    return Leaving{Leaving::Over::kTouchLine, x, std::copysign(pitch.halfWidth, to.y)};
  }
  if (overGoalLine <= 1.0 && !isInMouth) {
    const double y =
        std::clamp(between(from.y, to.y, overGoalLine), -pitch.halfWidth, pitch.halfWidth);
    return Leaving{Leaving::Over::kGoalLine, std::copysign(pitch.halfLength, to.x), y};
  }
  return std::nullopt;
}

}  // namespace ortung::soccer

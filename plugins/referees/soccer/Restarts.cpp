#include "Restarts.hpp"

#include <algorithm>
#include <cmath>

namespace ortung::soccer {
namespace {

FloorPoint nearestMark(const FloorPoint& at, const std::vector<FloorPoint>& marks) {
  return *std::min_element(marks.begin(), marks.end(), [&](const auto& a, const auto& b) {
    return std::hypot(a.x - at.x, a.y - at.y) < std::hypot(b.x - at.x, b.y - at.y);
  });
}

FloorPoint onPitch(const FloorPoint& at, const Pitch& pitch, double insideX, double insideY) {
  const double x = std::max(pitch.halfLength - insideX, 0.0);
  const double y = std::max(pitch.halfWidth - insideY, 0.0);
  return {std::clamp(at.x, -x, x), std::clamp(at.y, -y, y)};
}

double sideOf(double value) { return value < 0.0 ? -1.0 : 1.0; }

FloorPoint goalKickPlace(double end, const FloorPoint& at, const Pitch& pitch,
                         const Rules::Places& places) {
  const double depth = places.goalKickDepth.value_or(pitch.goalArea.depth);
  const double aside = places.goalKickAside.value_or(pitch.goalArea.width / 2.0);
  return onPitch({end * (pitch.halfLength - depth), sideOf(at.y) * aside}, pitch, 0.0, 0.0);
}

}  // namespace

std::size_t defenderOf(double x, const Game& game) {
  return x < 0.0 ? game.teamOnTheLeft : 1 - game.teamOnTheLeft;
}

Restart restartAt(Game::Restart kind, std::optional<std::size_t> team, const FloorPoint& at,
                  const Pitch& pitch, const Rules::Places& places, const Game& game) {
  const double forward = team ? game.directionOf(game.teams[*team].name) : 1.0;
  const auto marks = pitch.marks(places);
  FloorPoint place = onPitch(at, pitch, 0.0, 0.0);
  switch (kind) {
    case Game::Restart::kNone:
      break;
    case Game::Restart::kKickOff:
      place = {0.0, 0.0};
      break;
    case Game::Restart::kThrowIn:
      place.y = sideOf(at.y) * (pitch.halfWidth - places.throwInInside);
      break;
    case Game::Restart::kGoalKick:
      place = goalKickPlace(-forward, at, pitch, places);
      break;
    case Game::Restart::kCorner:
      place = {forward * (pitch.halfLength - places.cornerInside),
               sideOf(at.y) * (pitch.halfWidth - places.cornerInside)};
      break;
    case Game::Restart::kFreeKick: {
      const bool isInArea = pitch.isIn(pitch.penaltyArea, sideOf(at.x), at.x, at.y);
      if (isInArea && places.freeKickAtMark && !marks.empty()) place = nearestMark(at, marks);
      break;
    }
    case Game::Restart::kPenalty:
      place = {forward * (pitch.halfLength - pitch.penaltyMark), 0.0};
      break;
    case Game::Restart::kDroppedBall:
      if (places.dropsAtMark && !marks.empty()) place = nearestMark(at, marks);
      break;
  }
  return {kind, kind == Game::Restart::kDroppedBall ? std::nullopt : team, place};
}

Restart restartAfter(const Leaving& leaving, std::optional<std::size_t> last, const Pitch& pitch,
                     const Rules::Places& places, const Game& game) {
  const std::size_t defender = defenderOf(leaving.x, game);
  const FloorPoint at{leaving.x, leaving.y};
  if (leaving.over == Leaving::Over::kTouchLine) {
    const std::size_t team = last ? 1 - *last : defender;
    return restartAt(Game::Restart::kThrowIn, team, at, pitch, places, game);
  }
  if (last == defender)
    return restartAt(Game::Restart::kCorner, 1 - defender, at, pitch, places, game);
  return restartAt(Game::Restart::kGoalKick, defender, at, pitch, places, game);
}

FloorPoint putBack(const Leaving& leaving, const Pitch& pitch, double inside) {
  const bool overTouchLine = leaving.over == Leaving::Over::kTouchLine;
  return onPitch({leaving.x, leaving.y}, pitch, overTouchLine ? 0.0 : inside,
                 overTouchLine ? inside : 0.0);
}

}  // namespace ortung::soccer

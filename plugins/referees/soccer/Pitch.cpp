#include "Pitch.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace ortung::soccer {
namespace {

constexpr double kNear = 0.15;  ///< distance from a line within which something belongs to it [m]
constexpr double kStraight = 1e-6;  ///< tolerance of straight lines [m]
/// Height above which a body does not stop a ball on the floor [m].
constexpr double kBallHeight = 0.25;
/// Least radius of a centre circle; smaller ones are spots [m].
constexpr double kLeastCircle = 0.3;

/// The extent of the painted lines.
struct Painted {
  double halfLength = 0.0;
  double halfWidth = 0.0;
};

bool isAcross(const FieldLine& line) {
  return line.shape == FieldLine::Shape::kStraight && std::abs(line.x0 - line.x1) < kStraight;
}

Painted paintedOn(const World& world) {
  Painted painted;
  for (const FieldLine& line : world.lines()) {
    if (line.shape != FieldLine::Shape::kStraight) continue;
    const double half = line.width / 2.0;
    if (isAcross(line)) {
      painted.halfLength = std::max(painted.halfLength, std::abs(line.x0) + half);
    } else if (std::abs(line.y0 - line.y1) < kStraight) {
      painted.halfWidth = std::max(painted.halfWidth, std::abs(line.y0) + half);
    }
  }
  return painted;
}

/// The extent of the goals' bodies at a ball's height.
struct Goals {
  /// Where they begin: distance from the middle [m].
  double mouth = std::numeric_limits<double>::infinity();
  double end = 0.0;  ///< distance from the middle to their end [m]
  bool areTwo = false;
};

template <class Action>
void forEachGoalPoint(const World& world, const Action& action) {
  for (const WorldObject& object : world.objects()) {
    if (object.kind != "goal" || object.isMovable) continue;
    for (const WorldPiece& piece : object.pieces)
      if (piece.zLow < kBallHeight)
        for (const FloorPoint& point : outlineOf(object, piece)) action(point);
  }
}

Goals goalsOf(const World& world) {
  Goals goals;
  bool left = false;
  bool right = false;
  forEachGoalPoint(world, [&](const FloorPoint& point) {
    goals.mouth = std::min(goals.mouth, std::abs(point.x));
    goals.end = std::max(goals.end, std::abs(point.x));
    (point.x < 0.0 ? left : right) = true;
  });
  goals.areTwo = left && right;
  return goals;
}

/// Returns half the inner width of the mouth: between the bodies on both sides of the goal line.
double halfMouth(const World& world, double halfLength) {
  double inner = std::numeric_limits<double>::infinity();
  for (const WorldObject& object : world.objects()) {
    if (object.kind != "goal" || object.isMovable) continue;
    for (const WorldPiece& piece : object.pieces) {
      if (piece.zLow >= kBallHeight) continue;
      double nearest = std::numeric_limits<double>::infinity();
      double toLine = nearest;
      for (const FloorPoint& point : outlineOf(object, piece)) {
        nearest = std::min(nearest, std::abs(point.y));
        toLine = std::min(toLine, std::abs(std::abs(point.x) - halfLength));
      }
      if (toLine < kNear) inner = std::min(inner, nearest);
    }
  }
  return std::isfinite(inner) ? inner : 0.0;
}

/// Reads the areas before the goals, which end in lines across the field that are shorter than the
/// goal line.
void readAreas(const World& world, Pitch& pitch) {
  std::vector<AreaSize> areas;
  for (const FieldLine& line : world.lines()) {
    if (!isAcross(line) || line.x0 < kNear) continue;
    const double width = std::abs(line.y1 - line.y0);
    const double depth = pitch.halfLength - line.x0 + line.width / 2.0;
    if (depth > kNear + line.width && width < 2.0 * pitch.halfWidth - kNear)
      areas.push_back({depth, width});
  }
  std::sort(areas.begin(), areas.end(),
            [](const AreaSize& a, const AreaSize& b) { return a.depth < b.depth; });
  if (!areas.empty()) pitch.penaltyArea = areas.back();
  if (areas.size() > 1) pitch.goalArea = areas.front();
}

void readRound(const World& world, Pitch& pitch) {
  for (const FieldLine& line : world.lines()) {
    if (line.shape != FieldLine::Shape::kArc || std::abs(line.y) > kStraight) continue;
    const double radius = line.radiusX + line.width / 2.0;
    if (std::abs(line.x) < kStraight && radius > kLeastCircle) pitch.circle = radius;
    if (line.x > kNear && radius < kLeastCircle) pitch.penaltyMark = pitch.halfLength - line.x;
  }
}

[[noreturn]] void miss(const char* what, const char* key) {
  throw ConfigError("the referee can't find " + std::string(what) +
                    " in the world; the rules may give it: [pitch] " + key);
}

}  // namespace

Pitch Pitch::of(const World& world, const Rules::Pitch& rules) {
  const Painted painted = paintedOn(world);
  const Goals goals = goalsOf(world);
  Pitch pitch;
  pitch.halfLength = rules.length   ? *rules.length / 2.0
                     : goals.areTwo ? (painted.halfLength > 0.0 ? painted.halfLength : goals.mouth)
                                    : 0.0;
  if (!(pitch.halfLength > 0.0)) miss("where two goals are", "length_m");
  pitch.halfWidth = rules.width ? *rules.width / 2.0 : painted.halfWidth;
  if (!(pitch.halfWidth > 0.0)) miss("where the touch lines are", "width_m");
  pitch.halfGoal = rules.goalWidth ? *rules.goalWidth / 2.0 : halfMouth(world, pitch.halfLength);
  if (!(pitch.halfGoal > 0.0)) miss("how wide the goals are", "goal_width_m");
  pitch.goalDepth = rules.goalDepth.value_or(std::max(goals.end - pitch.halfLength, 0.0));
  readAreas(world, pitch);
  readRound(world, pitch);
  if (rules.goalArea) pitch.goalArea = *rules.goalArea;
  if (rules.penaltyArea) pitch.penaltyArea = *rules.penaltyArea;
  if (rules.circle) pitch.circle = *rules.circle;
  if (rules.penaltyMark) pitch.penaltyMark = *rules.penaltyMark;
  if (!(pitch.penaltyMark > 0.0)) pitch.penaltyMark = pitch.halfLength / 3.0;
  return pitch;
}

bool Pitch::isIn(const AreaSize& area, double side, double x, double y) const {
  return area.depth > 0.0 && x * side >= halfLength - area.depth && x * side <= halfLength &&
         std::abs(y) <= area.width / 2.0;
}

std::vector<FloorPoint> Pitch::marks(const Rules::Places& places) const {
  if (!places.marksX) return {};
  const double x = std::min(*places.marksX, halfLength);
  const double y = 2.0 * halfWidth * places.marksY;
  return {{x, y}, {x, -y}, {-x, y}, {-x, -y}};
}

}  // namespace ortung::soccer

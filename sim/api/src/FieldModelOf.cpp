#include <algorithm>

#include "ortung/sim_api/World.hpp"

namespace ortung {
namespace {

/// Adds the sides of a rectangle, clockwise: its outside is on their left.
void addSides(const WorldObject& o, std::vector<FieldWall>& walls) {
  const Pose2 corners[] = {
      o.pose * Pose2{-o.halfX, -o.halfY, 0.0}, o.pose * Pose2{-o.halfX, o.halfY, 0.0},
      o.pose * Pose2{o.halfX, o.halfY, 0.0}, o.pose * Pose2{o.halfX, -o.halfY, 0.0}};
  for (std::size_t i = 0; i < 4; ++i) {
    const Pose2& a = corners[i];
    const Pose2& b = corners[(i + 1) % 4];
    walls.push_back({a.x, a.y, b.x, b.y, o.zLow, o.zHigh, o.kind == "goal"});
  }
}

}  // namespace

FieldModel fieldModelOf(const World& world) {
  FieldModel field;
  const auto lines = world.lines();
  field.lines.assign(lines.begin(), lines.end());
  const auto landmarks = world.landmarks();
  field.landmarks.assign(landmarks.begin(), landmarks.end());
  for (const WorldObject& o : world.objects()) {
    if (o.isMovable) continue;
    const bool isGoal = o.kind == "goal";
    if (isGoal) field.goals.push_back({o.name, o.colour, o.pose, o.halfX, o.halfY, o.zHigh});
    if ((isGoal || o.kind == "wall") && !o.isRound) addSides(o, field.walls);
  }
  const auto mapWalls = world.mapWalls();
  field.walls.insert(field.walls.end(), mapWalls.begin(), mapWalls.end());
  std::stable_sort(
      field.walls.begin(), field.walls.end(),
      [](const FieldWall& a, const FieldWall& b) { return lengthOf(a) > lengthOf(b); });
  return field;
}

}  // namespace ortung

#include "Scene.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace ortung::soccer {
namespace {

constexpr double kFar = 1e9;  ///< distance of something that does not exist [m]
/// Distance of the ball from a robot's circle below which its exact body is used [m].
constexpr double kNear = 0.5;

/// Returns the distance of a point from a segment [m].
double toSegment(const FloorPoint& p, const FloorPoint& a, const FloorPoint& b) {
  const double dx = b.x - a.x;
  const double dy = b.y - a.y;
  const double square = dx * dx + dy * dy;
  double t = square > 0.0 ? ((p.x - a.x) * dx + (p.y - a.y) * dy) / square : 0.0;
  t = std::clamp(t, 0.0, 1.0);
  return std::hypot(p.x - a.x - t * dx, p.y - a.y - t * dy);
}

/// Returns the distance of a point from a convex outline [m]; 0 inside.
double toOutline(const FloorPoint& p, const std::vector<FloorPoint>& outline) {
  double nearest = kFar;
  bool isInside = true;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const FloorPoint& a = outline[i];
    const FloorPoint& b = outline[(i + 1) % outline.size()];
    nearest = std::min(nearest, toSegment(p, a, b));
    isInside = isInside && (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x) >= 0.0;
  }
  return isInside ? 0.0 : nearest;
}

double gap(const Scene::Ball& ball, const StagedRobot& robot, const WorldObject* body) {
  const double toCircle =
      std::hypot(ball.x - robot.pose.x, ball.y - robot.pose.y) - robot.radius - ball.radius;
  if (body == nullptr || body->pieces.empty() || toCircle > kNear) return toCircle;
  double least = kFar;
  for (const WorldPiece& piece : body->pieces)
    if (piece.zLow < 2.0 * ball.radius)
      least = std::min(least, toOutline({ball.x, ball.y}, outlineOf(*body, piece)) - ball.radius);
  return least;
}

}  // namespace

Scene Scene::of(const Stage& stage, const Game& game, double ballRadius) {
  Scene scene;
  scene.now = stage.now();
  const auto objects = stage.world().objects();
  const auto bodyOf = [&](const std::string& name, const char* kind) -> const WorldObject* {
    const auto found = std::find_if(objects.begin(), objects.end(), [&](const WorldObject& o) {
      return o.isMovable && o.kind == kind && o.name == name;
    });
    return found == objects.end() ? nullptr : &*found;
  };
  for (const StagedThing& thing : stage.things()) {
    if (thing.kind != "ball") continue;
    const WorldObject* body = bodyOf(thing.name, "ball");
    const double radius = body != nullptr && body->halfX > 0.0 ? body->halfX : ballRadius;
    scene.ball = {thing.name,       thing.pose.x,     thing.pose.y,
                  thing.velocity.x, thing.velocity.y, radius};
    break;
  }
  for (const StagedRobot& robot : stage.robots()) {
    const WorldObject* body = bodyOf(robot.name, "robot");
    RobotSize size{robot.radius};
    if (body != nullptr && body->zHigh > 0.0) size.height = body->zHigh;
    scene.robots.push_back({robot.name, game.find(robot.team), robot.pose, size,
                            scene.ball ? gap(*scene.ball, robot, body) : kFar});
  }
  return scene;
}

const Scene::Robot* Scene::find(std::string_view name) const {
  const auto found =
      std::find_if(robots.begin(), robots.end(), [&](const Robot& r) { return r.name == name; });
  return found == robots.end() ? nullptr : &*found;
}

const Scene::Robot* nearest(const Scene& scene, std::size_t team, const FloorPoint& point) {
  const Scene::Robot* best = nullptr;
  double least = kFar;
  for (const Scene::Robot& robot : scene.robots) {
    const double distance = std::hypot(robot.pose.x - point.x, robot.pose.y - point.y);
    if (robot.team == team && distance < least) {
      least = distance;
      best = &robot;
    }
  }
  return best;
}

}  // namespace ortung::soccer

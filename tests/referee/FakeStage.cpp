#include "FakeStage.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace ortung::test {
namespace {

constexpr int kSteps = 10;  // of a cycle

/// The point of a convex outline that is nearest to p.
FloorPoint nearestOn(const std::vector<FloorPoint>& outline, const FloorPoint& p) {
  FloorPoint best;
  double least = 1e9;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const FloorPoint& a = outline[i];
    const FloorPoint& b = outline[(i + 1) % outline.size()];
    const double dx = b.x - a.x;
    const double dy = b.y - a.y;
    const double square = dx * dx + dy * dy;
    const double t =
        square > 0.0 ? std::clamp(((p.x - a.x) * dx + (p.y - a.y) * dy) / square, 0.0, 1.0) : 0.0;
    const FloorPoint point{a.x + t * dx, a.y + t * dy};
    const double distance = std::hypot(p.x - point.x, p.y - point.y);
    if (distance < least) {
      least = distance;
      best = point;
    }
  }
  return best;
}

/// Lets a ball that touches a surface at `at`, which moves with a velocity, bounce off.
void bounce(StagedThing& ball, const FloorPoint& at, double radius, const Twist& surface) {
  const double dx = ball.pose.x - at.x;
  const double dy = ball.pose.y - at.y;
  const double distance = std::hypot(dx, dy);
  if (distance >= radius || distance == 0.0) return;
  const double nx = dx / distance;
  const double ny = dy / distance;
  ball.pose.x = at.x + nx * radius;
  ball.pose.y = at.y + ny * radius;
  const double approach = (ball.velocity.x - surface.x) * nx + (ball.velocity.y - surface.y) * ny;
  if (approach >= 0.0) return;
  ball.velocity.x -= (1.0 + FakeStage::kRestitution) * approach * nx;
  ball.velocity.y -= (1.0 + FakeStage::kRestitution) * approach * ny;
}

WorldObject roundBody(const char* kind, const std::string& name, const Pose2& pose, double radius,
                      double height) {
  WorldObject body;
  body.kind = kind;
  body.name = name;
  body.pose = pose;
  body.radius = body.halfX = body.halfY = radius;
  body.zHigh = height;
  body.isRound = body.isMovable = true;
  WorldPiece& piece = body.pieces.emplace_back();
  piece.shape = WorldPiece::Shape::kEllipse;
  piece.halfX = piece.halfY = radius;
  piece.zHigh = height;
  return body;
}

}  // namespace

StageWorld::StageWorld(const std::filesystem::path& file) : field_(readWorld(file)) {
  for (const WorldObject& object : field_->objects()) {
    if (object.isMovable) continue;
    objects_.push_back(object);
    for (const WorldPiece& piece : object.pieces)
      if (piece.zLow < 2.0 * FakeStage::kBallRadius) obstacles_.push_back(outlineOf(object, piece));
  }
  fixed_ = objects_.size();
}

void StageWorld::show(std::span<const StagedRobot> robots, std::span<const StagedThing> things,
                      double ballRadius) {
  objects_.resize(fixed_);
  for (const StagedRobot& robot : robots)
    objects_.push_back(roundBody("robot", robot.name, robot.pose, robot.radius, 0.6));
  for (const StagedThing& thing : things)
    objects_.push_back(
        roundBody(thing.kind.c_str(), thing.name, thing.pose, ballRadius, 2.0 * ballRadius));
}

FakeStage::FakeStage(const std::filesystem::path& world, double cycle)
    : world_(world), cycle_(cycle) {}

void FakeStage::checkRoom(std::string_view self, double x, double y, double radius) const {
  const auto meets = [&](const Pose2& pose, double other) {
    return std::hypot(pose.x - x, pose.y - y) < radius + other;
  };
  for (const StagedRobot& robot : robots_)
    if (robot.name != self && meets(robot.pose, robot.radius))
      throw std::invalid_argument("no room beside " + robot.name);
  for (const StagedThing& thing : things_)
    if (thing.name != self && meets(thing.pose, kBallRadius))
      throw std::invalid_argument("no room beside " + thing.name);
  if (!world_.isFree(x, y, {radius, 0.2})) throw std::invalid_argument("no room there");
}

void FakeStage::placeRobot(std::string_view name, const Pose2& pose) {
  StagedRobot* robot = find(name);
  if (robot == nullptr) throw std::invalid_argument("no robot " + std::string(name));
  checkRoom(name, pose.x, pose.y, robot->radius);
  robot->pose = pose;
  show();
}

void FakeStage::placeThing(std::string_view name, const Pose2& pose, const Twist& velocity) {
  const auto thing =
      std::find_if(things_.begin(), things_.end(), [&](const auto& t) { return t.name == name; });
  if (thing == things_.end()) throw std::invalid_argument("no thing " + std::string(name));
  checkRoom(name, pose.x, pose.y, kBallRadius);
  thing->pose = pose;
  thing->velocity = velocity;
  show();
}

std::shared_ptr<const FloorPlan> FakeStage::floorPlan(const RobotSize&) {
  throw std::invalid_argument("a fake stage has no floor plan");
}

void FakeStage::set(const StagedRobot& robot) {
  if (StagedRobot* found = find(robot.name)) {
    *found = robot;
  } else {
    robots_.push_back(robot);
  }
  show();
}

void FakeStage::set(const StagedThing& thing) {
  if (things_.empty()) {
    things_.push_back(thing);
  } else {
    things_.front() = thing;
  }
  show();
}

void FakeStage::remove(std::string_view name) {
  std::erase_if(robots_, [&](const StagedRobot& robot) { return robot.name == name; });
  show();
}

StagedRobot* FakeStage::find(std::string_view name) {
  const auto found = std::find_if(robots_.begin(), robots_.end(),
                                  [&](const StagedRobot& robot) { return robot.name == name; });
  return found == robots_.end() ? nullptr : &*found;
}

void FakeStage::move(const std::vector<bool>& held) {
  const double dt = cycle_ / kSteps;
  for (int step = 0; step < kSteps; ++step) {
    for (std::size_t i = 0; i < robots_.size(); ++i) {
      if (held[i]) continue;
      robots_[i].pose.x += robots_[i].velocity.x * dt;
      robots_[i].pose.y += robots_[i].velocity.y * dt;
    }
    for (StagedThing& thing : things_) moveBall(thing, dt, held);
  }
  now_ += fromSeconds(cycle_);
  show();
}

void FakeStage::moveBall(StagedThing& ball, double dt, const std::vector<bool>& held) const {
  ball.pose.x += ball.velocity.x * dt;
  ball.pose.y += ball.velocity.y * dt;
  const double speed = std::hypot(ball.velocity.x, ball.velocity.y);
  const double slower = std::max(speed - kDeceleration * dt, 0.0);
  if (speed > 0.0) {
    ball.velocity.x *= slower / speed;
    ball.velocity.y *= slower / speed;
  }
  for (std::size_t i = 0; i < robots_.size(); ++i)
    bounce(ball, {robots_[i].pose.x, robots_[i].pose.y}, robots_[i].radius + kBallRadius,
           held[i] ? Twist{} : robots_[i].velocity);
  for (const auto& outline : world_.obstacles())
    bounce(ball, nearestOn(outline, {ball.pose.x, ball.pose.y}), kBallRadius, {});
}

}  // namespace ortung::test

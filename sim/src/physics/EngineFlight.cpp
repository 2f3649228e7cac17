#include <box2d/b2_distance.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "Engine.hpp"
#include "ortung/base/Angles.hpp"

// Bodies that nothing can touch in a step move without the engine.
namespace ortung {
namespace {

constexpr double kRoom = 0.1;  ///< free space around bodies that all fly together [m]
constexpr int kPatience = 8;   ///< steps until free space is looked for again
/// How far two bodies come nearer in a step at most, in ways of the fastest: one drives, and the
/// other, a light one, is hit by a third and gets thrice its speed (paper, eqs. 1 and 5).
constexpr double kNearer = 4.0;
constexpr double kMargin = 0.02;       ///< further distance from which bodies fly [m]
constexpr double kFarthestLook = 1.0;  ///< distance in which fixed things are looked for [m]

/// Tests whether anything is near a body.
class Neighbours : public b2QueryCallback {
 public:
  explicit Neighbours(const b2Body* self) : self_(self) {}
  bool ReportFixture(b2Fixture* fixture) override {
    found_ = fixture->GetBody() != self_;
    return !found_;
  }
  bool isFound() const { return found_; }

 private:
  const b2Body* self_;
  bool found_ = false;
};

/// Finds the distance from a circle to the nearest fixed shape.
class FixedDistance : public b2QueryCallback {
 public:
  FixedDistance(const b2CircleShape& circle, std::span<const std::unique_ptr<Heights>> heights)
      : heights_(heights) {
    input_.proxyB.Set(&circle, 0);
    input_.transformA.SetIdentity();
    input_.transformB.SetIdentity();
    input_.useRadii = true;
  }
  bool ReportFixture(b2Fixture* fixture) override {
    const auto meets = [&](const auto& range) { return overlap(*range, heightsOf(*fixture)); };
    if (fixture->GetBody()->GetType() != b2_staticBody ||
        std::none_of(heights_.begin(), heights_.end(), meets))
      return true;
    input_.proxyA.Set(fixture->GetShape(), 0);
    input_.transformA = fixture->GetBody()->GetTransform();
    b2SimplexCache cache;
    cache.count = 0;
    b2DistanceOutput output;
    b2Distance(&output, &cache, &input_);
    least_ = std::min(least_, output.distance);
    return true;
  }
  float least() const { return least_; }

 private:
  std::span<const std::unique_ptr<Heights>> heights_;
  b2DistanceInput input_;
  float least_ = std::numeric_limits<float>::max();
};

b2AABB boxAround(const b2Vec2& middle, float half) {
  b2AABB box;
  box.lowerBound = middle - b2Vec2(half, half);
  box.upperBound = middle + b2Vec2(half, half);
  return box;
}

}  // namespace

/// Moves a body by its velocity, without the engine.
void Physics::Engine::fly(Item& item, double dt) {
  const Point2 arm = item.arm(item.pose.theta);
  const double theta = item.pose.theta + static_cast<double>(item.givenTurn) * dt;
  const Point2 newArm = item.arm(theta);
  item.pose.x += toMetres(item.given.x) * dt + arm.x - newArm.x;
  item.pose.y += toMetres(item.given.y) * dt + arm.y - newArm.y;
  item.pose.theta = wrapAngle(theta);
}

/// Passes the pose of a body that moved without the engine to it.
void Physics::Engine::land(Item& item) {
  if (!item.isFlying) return;
  item.isFlying = false;
  item.patience = kPatience;
  if (!likeVersion02) setEnabled(item, true);
  transform(item);
  item.before = item.body->GetPosition();
  item.beforeAngle = item.body->GetAngle();
}

void Physics::Engine::land() {
  for (Item& item : items)
    if (item.body != nullptr) land(item);
}

/// Decides which bodies move without the engine. @returns whether there are others
/// @param dt length of the part of a step [s]
/// @param isFirst whether the step begins with it
bool Physics::Engine::chooseFlying(double dt, bool isFirst) {
  double fastest = 0.0;
  for (Item& item : items) {
    if (item.body == nullptr) continue;
    item.way = dt * (toMetres(item.given.Length()) +
                     std::abs(static_cast<double>(item.givenTurn)) *
                         (item.reach + std::hypot(item.centre.x, item.centre.y)));
    fastest = std::max(fastest, item.way);
  }
  const double nearer = kNearer * fastest;
  findNear(nearer);
  bool areAllFlying = true;
  for (Item& item : items) {
    if (item.body == nullptr) continue;
    const bool canFly = !item.isNear && hasRoom(item, nearer);
    if (item.isFlying && !canFly) land(item);
    if (!item.isFlying && canFly && isFirst) takeOff(item);
    areAllFlying = areAllFlying && item.isFlying;
  }
  return !areAllFlying;
}

/// Marks the bodies that another moving one may touch: that is as near as this [m], or little
/// farther if it does not fly.
void Physics::Engine::findNear(double distance) {
  inOrder.clear();
  for (Item& item : items) {
    if (item.body == nullptr) continue;
    item.isNear = false;
    const Point2 place = placeOf(item);
    const double radius = item.reach + 0.5 * (distance + (item.isFlying ? 0.0 : kMargin));
    inOrder.push_back({place.x - radius, place.x, place.y, radius, &item});
  }
  std::sort(inOrder.begin(), inOrder.end(),
            [](const Disc& a, const Disc& b) { return a.left < b.left; });
  for (std::size_t i = 0; i < inOrder.size(); ++i) {
    const Disc& a = inOrder[i];
    for (std::size_t k = i + 1; k < inOrder.size(); ++k) {
      const Disc& b = inOrder[k];
      if (b.left > a.x + a.radius) break;
      const double sum = a.radius + b.radius;
      const double dx = b.x - a.x;
      const double dy = b.y - a.y;
      if (dx * dx + dy * dy > sum * sum) continue;
      a.item->isNear = b.item->isNear = true;
    }
  }
}

/// Returns whether no fixed thing is as near to a body as this [m].
bool Physics::Engine::hasRoom(Item& item, double distance) {
  if (item.isNear) return false;
  item.roamed += item.way;
  if (item.isFlying && item.room - item.roamed > distance) return true;
  if (!item.isFlying && --item.patience > 0) return false;
  item.patience = kPatience;
  b2CircleShape circle;
  circle.m_p = toEngine({placeOf(item).x - middle.x, placeOf(item).y - middle.y});
  circle.m_radius = toEngine(item.reach);
  FixedDistance fixed(circle, item.heights);
  world.QueryAABB(&fixed, boxAround(circle.m_p, toEngine(item.reach + kFarthestLook)));
  item.room = std::min(toMetres(fixed.least()), kFarthestLook);
  item.roamed = item.way;
  return item.room - item.way > distance + (item.isFlying ? 0.0 : kMargin);
}

void Physics::Engine::takeOff(Item& item) {
  item.isFlying = true;
  setEnabled(item, false);
}

/// Sets whether the engine sees a body.
void Physics::Engine::setEnabled(Item& item, bool isEnabled) {
  item.body->SetEnabled(isEnabled);
  if (item.properties.floor == Floor::kDrives) item.floor->SetEnabled(isEnabled);
}

Point2 Physics::Engine::placeOf(const Item& item) const {
  if (item.isFlying) return {item.pose.x, item.pose.y};
  const b2Vec2& place = item.body->GetPosition();
  return {toMetres(place.x) + middle.x, toMetres(place.y) + middle.y};
}

/// Lets all bodies move without the engine if none can touch another in this step: all had free
/// space around them, and none has used up its half of it.
bool Physics::Engine::flyTogether(double dt) {
  if (!canAllFly) return false;
  for (Item& item : items) {
    if (item.body == nullptr) continue;
    item.roamed += dt * (toMetres(item.given.Length()) +
                         std::abs(static_cast<double>(item.givenTurn)) * item.reach);
    if (item.roamed > kRoom / 2.0) return canAllFly = false;
  }
  for (Item& item : items) item.isFlying = item.body != nullptr;
  return true;
}

/// Tests whether all bodies have free space around them.
void Physics::Engine::lookForRoom() {
  if (world.GetContactCount() > 0 || --patience > 0) return;
  for (Item& item : items) {
    if (item.body == nullptr) continue;
    item.roamed = 0.0;
    Neighbours neighbours(item.body);
    world.QueryAABB(&neighbours, boxAround(item.body->GetPosition(), toEngine(item.reach + kRoom)));
    if (!neighbours.isFound()) continue;
    patience = kPatience;
    return;
  }
  canAllFly = true;
}

}  // namespace ortung

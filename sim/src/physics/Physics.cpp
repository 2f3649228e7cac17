#include "Physics.hpp"

#include <box2d/b2_distance.h>

#include <algorithm>

#include "BoxShapes.hpp"
#include "Engine.hpp"

namespace ortung {

Physics::Physics(const PhysicsConfig& config, const Solids& solids, bool likeVersion02)
    : engine_(std::make_unique<Engine>(config, solids, likeVersion02)) {}

Physics::~Physics() = default;

Physics::Body Physics::add(std::span<const Primitive> pieces, const Properties& properties,
                           const Pose2& pose) {
  engine_->wake();
  auto& items = engine_->items;
  const auto unused = std::find_if(items.begin(), items.end(),
                                   [](const Engine::Item& item) { return item.body == nullptr; });
  const auto place = static_cast<Body>(unused - items.begin());
  if (unused == items.end()) items.emplace_back();
  Engine::Item& item = items[place];
  item.properties = properties;
  item.pose = item.planned = pose;
  engine_->create(item, withoutHidden(pieces));
  return place;
}

void Physics::remove(Body body) {
  engine_->wake();
  engine_->destroy(engine_->items[body]);
}

void Physics::place(Body body, const Pose2& pose, const Twist& velocity) {
  engine_->wake();
  Engine::Item& item = engine_->items[body];
  item.pose = item.planned = pose;
  engine_->transform(item);
  item.body->SetAngularVelocity(single(velocity.theta));
  const Point2 arm = item.arm(pose.theta);
  item.body->SetLinearVelocity(
      toEngine({velocity.x - velocity.theta * arm.y, velocity.y + velocity.theta * arm.x}));
}

void Physics::want(Body body, const Pose2& change) {
  Engine::Item& item = engine_->items[body];
  item.planned = item.pose * change;
}

void Physics::hit(Body body, const Point2& impulse, const Point2& point) {
  engine_->wake();
  engine_->items[body].body->ApplyLinearImpulse(toEngine(impulse),
                                                engine_->positionOf({point.x, point.y, 0.0}), true);
}

bool Physics::isFree(std::span<const Primitive> pieces, const Pose2& pose, Body self) const {
  engine_->land();
  const b2Transform place(engine_->positionOf(pose), b2Rot(single(pose.theta)));
  const b2Body* own = self == kNobody ? nullptr : engine_->items[self].body;
  for (const Primitive& piece : pieces) {
    const Heights heights{piece.zLow, piece.zHigh, {}};
    for (const auto& shape : boxShapesOf(piece))
      if (Touching(*shape, heights, place, own).lookIn(engine_->world)) return false;
  }
  return true;
}

bool Physics::reaches(Body body, std::span<const Primitive> pieces, Body other,
                      double reach) const {
  engine_->land();
  const Engine::Item& from = engine_->items[body];
  b2Body* to = engine_->items[other].body;
  for (const Primitive& piece : pieces) {
    for (const auto& shape : boxShapesOf(piece)) {
      for (b2Fixture* fixture = to->GetFixtureList(); fixture; fixture = fixture->GetNext()) {
        if (!overlap({piece.zLow, piece.zHigh, {}}, heightsOf(*fixture))) continue;
        b2DistanceInput input;
        input.proxyA.Set(shape.get(), 0);
        input.proxyB.Set(fixture->GetShape(), 0);
        input.transformA = from.body->GetTransform();
        input.transformB = to->GetTransform();
        input.useRadii = true;
        b2SimplexCache cache;
        cache.count = 0;
        b2DistanceOutput output;
        b2Distance(&output, &cache, &input);
        if (toMetres(output.distance) <= reach) return true;
      }
    }
  }
  return false;
}

void Physics::step(double dt) { engine_->step(dt); }

const Pose2& Physics::pose(Body body) const { return engine_->items[body].pose; }
Twist Physics::velocity(Body body) const { return engine_->velocityOf(engine_->items[body]); }
double Physics::mass(Body body) const { return engine_->items[body].properties.mass; }
double Physics::inertia(Body body) const { return engine_->items[body].inertia; }
Point2 Physics::centreOfMass(Body body) const {
  const Engine::Item& item = engine_->items[body];
  const Point2 arm = item.arm(item.pose.theta);
  return {item.pose.x + arm.x, item.pose.y + arm.y};
}
bool Physics::wasDisturbed(Body body) const { return engine_->items[body].isDisturbed; }

}  // namespace ortung

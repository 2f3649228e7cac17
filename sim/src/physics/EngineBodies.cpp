#include <algorithm>
#include <cmath>

#include "BoxShapes.hpp"
#include "Engine.hpp"

namespace ortung {
namespace {

constexpr double kFenceThickness = 1.0;  ///< thickness of the fence around the field [m]
constexpr double kHuge = 1e9;            ///< [m]
constexpr double kTile = 64.0;           ///< edge length of a part of the ground [m]

Point2 middleOf(const Box2& box) {
  return {(box.xLow + box.xHigh) / 2.0, (box.yLow + box.yHigh) / 2.0};
}

}  // namespace

Physics::Engine::Engine(const PhysicsConfig& c, const Solids& solids, bool isLikeVersion02)
    : config(c),
      middle(middleOf(solids.bounds)),
      bouncing(isLikeVersion02),
      world({0.0f, 0.0f}),
      likeVersion02(isLikeVersion02) {
  world.SetContactFilter(&filter);
  world.SetContactListener(&bouncing);
  world.SetAllowSleeping(false);
  b2BodyDef definition;
  ground = make(definition);
  addSolids(solids);
  addFence(solids.bounds);
}

b2Body* Physics::Engine::make(const b2BodyDef& definition) {
  stock.forBody(world);
  return world.CreateBody(&definition);
}

void Physics::Engine::attach(b2Body* body, std::span<const Primitive> pieces,
                             std::vector<std::unique_ptr<Heights>>& kept, const Point2& origin) {
  for (const Primitive& piece : pieces) {
    kept.push_back(std::make_unique<Heights>(Heights{piece.zLow, piece.zHigh, piece.restitution}));
    for (const auto& shape : boxShapesOf(piece, origin))
      attach(body, *shape, *kept.back(), piece.friction);
  }
}

void Physics::Engine::attach(b2Body* body, const b2Shape& shape, Heights& range,
                             const std::optional<double>& friction) {
  b2FixtureDef definition;
  definition.shape = &shape;
  definition.friction = single(friction.value_or(config.friction));
  definition.restitution = single(config.restitution);
  definition.restitutionThreshold = 0.0f;  // Newton's hypothesis holds at every speed
  definition.userData.pointer = reinterpret_cast<uintptr_t>(&range);
  stock.forFixture(world, shape);
  body->CreateFixture(&definition);
}

/// Returns the part of the ground around a place. Each has an origin of its own, so that single
/// precision is enough for small shapes anywhere.
b2Body* Physics::Engine::groundAt(const Point2& place, Point2& origin) {
  const std::pair<int, int> tile{static_cast<int>(std::round((place.x - middle.x) / kTile)),
                                 static_cast<int>(std::round((place.y - middle.y) / kTile))};
  origin = {middle.x + kTile * tile.first, middle.y + kTile * tile.second};
  b2Body*& body = tiles[tile];
  if (body == nullptr) {
    b2BodyDef definition;
    definition.position = positionOf({origin.x, origin.y, 0.0});
    body = make(definition);
  }
  return body;
}

void Physics::Engine::addSolids(const Solids& solids) {
  Point2 origin;
  for (const Primitive& primitive : solids.primitives) {
    b2Body* body = groundAt(primitive.centre, origin);
    attach(body, {&primitive, 1}, fixedHeights, origin);
  }
  for (const WallSegment& wall : solids.walls) {
    b2Body* body = groundAt(wall.from, origin);
    fixedHeights.push_back(std::make_unique<Heights>(Heights{wall.zLow, wall.zHigh, {}}));
    attach(body, *boxShapeOf(wall, origin), *fixedHeights.back());
  }
}

void Physics::Engine::addFence(const Box2& b) {
  const double t = kFenceThickness;
  fence.high = kHuge;
  fence.low = -kHuge;
  for (const Box2& box : {Box2{b.xLow - t, b.xLow, b.yLow - t, b.yHigh + t},
                          Box2{b.xHigh, b.xHigh + t, b.yLow - t, b.yHigh + t},
                          Box2{b.xLow - t, b.xHigh + t, b.yLow - t, b.yLow},
                          Box2{b.xLow - t, b.xHigh + t, b.yHigh, b.yHigh + t}}) {
    Primitive wall;
    wall.centre = middleOf(box);
    wall.halfX = (box.xHigh - box.xLow) / 2.0;
    wall.halfY = (box.yHigh - box.yLow) / 2.0;
    attach(ground, *boxShapesOf(wall, middle).front(), fence);
  }
}

void Physics::Engine::weigh(Item& item, std::span<const Primitive> pieces) {
  const Bulk bulk = bulkOf(pieces);
  item.centre = bulk.centre;
  item.inertia = bulk.inertia * item.properties.mass;
  item.reach = 0.0;
  for (const Primitive& piece : pieces) item.reach = std::max(item.reach, reachOf(piece));
  b2MassData data;
  data.mass = single(item.properties.mass);
  data.center = toEngine(item.centre);
  // The engine expects the moment of inertia around the body's origin.
  data.I = single(kScale * kScale *
                  (item.inertia + item.properties.mass * (item.centre.x * item.centre.x +
                                                          item.centre.y * item.centre.y)));
  item.body->SetMassData(&data);
  holdOn(item);
}

/// Joins a body to the floor at its centre of mass. The joint is solved together with contacts, so
/// that a body that is pushed too weakly does not move at all.
void Physics::Engine::holdOn(Item& item) {
  if (item.properties.floor == Floor::kRolls) return;
  if (item.grip != nullptr) world.DestroyJoint(item.grip);
  b2FrictionJointDef joint;
  joint.bodyA = item.floor;
  joint.bodyB = item.body;
  joint.localAnchorB = item.body->GetLocalCenter();
  joint.collideConnected = true;
  if (item.properties.floor == Floor::kSlides) {
    const double force = config.floorFriction * kGravity * item.properties.mass;
    joint.maxForce = single(kScale * force);
    // Friction that is uniform over a disc of radius r has a torque of 2/3 mu m g r.
    joint.maxTorque = single(kScale * kScale * force * 2.0 / 3.0 * item.reach);
  }
  stock.forJoint(world);
  item.grip = static_cast<b2FrictionJoint*>(world.CreateJoint(&joint));
}

void Physics::Engine::create(Item& item, std::span<const Primitive> pieces) {
  item.crowd = std::make_unique<Crowd>();
  b2BodyDef definition;
  definition.type = b2_dynamicBody;
  definition.position = positionOf(item.pose);
  definition.angle = single(item.pose.theta);
  definition.bullet = true;  // does not tunnel through other moving bodies between two steps
  definition.allowSleep = false;
  definition.userData.pointer = reinterpret_cast<uintptr_t>(item.crowd.get());
  item.body = make(definition);
  item.floor = ground;
  if (item.properties.floor == Floor::kDrives) {
    b2BodyDef floor;
    floor.type = b2_kinematicBody;
    floor.allowSleep = false;
    item.floor = make(floor);
  }
  attach(item.body, pieces, item.heights);
  weigh(item, pieces);
}

void Physics::Engine::destroy(Item& item) {
  world.DestroyBody(item.body);
  if (item.properties.floor == Floor::kDrives) world.DestroyBody(item.floor);
  item = {};
}

}  // namespace ortung

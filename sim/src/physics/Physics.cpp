#include "Physics.hpp"

#include <box2d/b2_distance.h>
#include <box2d/box2d.h>

#include <algorithm>
#include <cmath>

#include "BoxShapes.hpp"

namespace ortung {
namespace {

constexpr int32 kVelocityIterations = 8;
constexpr int32 kPositionIterations = 3;
constexpr double kLongestStep = 0.02;    ///< [s]; longer ones are done in parts
constexpr double kDrift = 2e-5;          ///< of the engine's single precision from ours [m], [rad]
constexpr double kRoom = 0.1;            ///< that bodies need around them to move freely [m]
constexpr int kPatience = 8;             ///< steps until it is looked for room again
constexpr double kFenceThickness = 1.0;  ///< around the field [m]
constexpr double kHuge = 1e9;            ///< [m]

float single(double value) { return static_cast<float>(value); }
b2Vec2 vec(const Point2& p) { return {single(p.x), single(p.y)}; }

Point2 rotated(const Point2& p, double angle) {
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  return {c * p.x - s * p.y, s * p.x + c * p.y};
}

/// What the engine keeps with every shape.
struct Heights {
  double low = 0.0, high = 0.0;       ///< [m]
  std::optional<double> restitution;  ///< of its own
};

/// Brings @p value nearer to 0 by at most @p step.
double braked(double value, double step) {
  return value > 0.0 ? std::max(value - step, 0.0) : std::min(value + step, 0.0);
}

class HeightFilter : public b2ContactFilter {
 public:
  bool ShouldCollide(b2Fixture* a, b2Fixture* b) override;
};

/// Says how much two bodies bounce: as the one says that has a restitution of its own, or as the
/// one says that bounces less.
class Bouncing : public b2ContactListener {
 public:
  void BeginContact(b2Contact* contact) override;
};

}  // namespace

struct Physics::Engine {
  struct Item {
    b2Body* body = nullptr;  ///< null: the place is free
    Properties properties;
    double reach = 0.0;         ///< of its shape from its origin [m]
    double inertia = 0.0;       ///< [kg m^2]
    Point2 centre;              ///< of mass, in its own frame [m]
    Pose2 pose;                 ///< in double precision
    Pose2 planned;              ///< where a driving body will be if nothing is in the way
    b2Vec2 wanted{0.0f, 0.0f};  ///< velocity of the centre of mass [m/s]
    float wantedTurn = 0.0f;    ///< [rad/s]
    b2Vec2 given{0.0f, 0.0f};   ///< velocity with which it went into the engine's step
    float givenTurn = 0.0f;
    b2Vec2 before{0.0f, 0.0f};  ///< position before the engine's step [m]
    float beforeAngle = 0.0f;
    double roamed = 0.0;  ///< what its farthest point may have moved since there was room [m]
    bool isDisturbed = false;
    std::vector<std::unique_ptr<Heights>> heights;  ///< of its shapes
  };

  explicit Engine(const PhysicsConfig& c) : config(c), world({0.0f, 0.0f}) {
    world.SetContactFilter(&filter);
    world.SetContactListener(&bouncing);
    world.SetAllowSleeping(false);
  }

  void attach(b2Body* body, std::span<const Primitive> pieces,
              std::vector<std::unique_ptr<Heights>>& kept) const {
    for (const Primitive& piece : pieces) {
      kept.push_back(
          std::make_unique<Heights>(Heights{piece.zLow, piece.zHigh, piece.restitution}));
      for (const auto& shape : boxShapesOf(piece))
        attach(body, *shape, *kept.back(), piece.friction);
    }
  }
  void attach(b2Body* body, const b2Shape& shape, Heights& range,
              const std::optional<double>& friction = {}) const {
    b2FixtureDef definition;
    definition.shape = &shape;
    definition.friction = single(friction.value_or(config.friction));
    definition.restitution = single(config.restitution);
    definition.restitutionThreshold = 0.0f;  // Newton's hypothesis holds at every speed
    definition.userData.pointer = reinterpret_cast<uintptr_t>(&range);
    body->CreateFixture(&definition);
  }
  void weigh(Item& item, std::span<const Primitive> pieces) const {
    const Bulk bulk = bulkOf(pieces);
    item.centre = bulk.centre;
    item.inertia = bulk.inertia * item.properties.mass;
    item.reach = 0.0;
    for (const Primitive& piece : pieces) item.reach = std::max(item.reach, reachOf(piece));
    b2MassData data;
    data.mass = single(item.properties.mass);
    data.center = vec(item.centre);
    // The engine takes the moment around the body's origin.
    data.I = single(item.inertia + item.properties.mass * (item.centre.x * item.centre.x +
                                                           item.centre.y * item.centre.y));
    item.body->SetMassData(&data);
  }
  void addFence(const Box2& b) {
    const double t = kFenceThickness;
    fence.high = kHuge;
    fence.low = -kHuge;
    for (const Box2& box : {Box2{b.xLow - t, b.xLow, b.yLow - t, b.yHigh + t},
                            Box2{b.xHigh, b.xHigh + t, b.yLow - t, b.yHigh + t},
                            Box2{b.xLow - t, b.xHigh + t, b.yLow - t, b.yLow},
                            Box2{b.xLow - t, b.xHigh + t, b.yHigh, b.yHigh + t}}) {
      Primitive wall;
      wall.centre = {(box.xLow + box.xHigh) / 2.0, (box.yLow + box.yHigh) / 2.0};
      wall.halfX = (box.xHigh - box.xLow) / 2.0;
      wall.halfY = (box.yHigh - box.yLow) / 2.0;
      attach(ground, *boxShapesOf(wall).front(), fence);
    }
  }

  /// Brings a body to what it wants, as far as its wheels have grip.
  void drive(Item& item, double dt) const {
    const double grip = config.floorFriction * kGravity * dt;  // [m/s]
    const b2Vec2 is = item.body->GetLinearVelocity();
    const b2Vec2 missing = item.wanted - is;
    item.given = item.wanted;
    if (static_cast<double>(missing.LengthSquared()) > grip * grip) {
      const double needed = static_cast<double>(missing.Length());
      item.given = is + single(grip / needed) * missing;
      item.isDisturbed = true;
    }
    // Wheels stand at about 0.7 of the body's radius, and all of them help to turn.
    const double turnGrip = grip * item.properties.mass * 0.7 * item.reach / item.inertia;
    const double isTurn = static_cast<double>(item.body->GetAngularVelocity());
    const double missingTurn = static_cast<double>(item.wantedTurn) - isTurn;
    item.givenTurn = item.wantedTurn;
    if (std::abs(missingTurn) > turnGrip) {
      item.givenTurn = single(isTurn + std::copysign(turnGrip, missingTurn));
      item.isDisturbed = true;
    }
  }

  /// A ball rolls on and slows down little; what slides, much.
  void brake(Item& item, double dt) const {
    const bool rolls = item.properties.floor == Floor::rolls;
    const double friction = rolls ? config.rollingResistance : config.floorFriction;
    const double step = friction * kGravity * dt;
    const b2Vec2 is = item.body->GetLinearVelocity();
    const double speed = static_cast<double>(is.Length());
    item.given = speed > 0.0 ? single(braked(speed, step) / speed) * is : is;
    // Friction evenly over a disc of radius r makes a torque of 2/3 mu m g r.
    const double turnStep = step * item.properties.mass * 2.0 / 3.0 * item.reach / item.inertia;
    item.givenTurn = single(braked(static_cast<double>(item.body->GetAngularVelocity()), turnStep));
  }

  void begin(Item& item, double dt) {
    if (item.properties.floor == Floor::drives)
      drive(item, dt);
    else
      brake(item, dt);
    item.body->SetLinearVelocity(item.given);
    item.body->SetAngularVelocity(item.givenTurn);
  }

  static void end(Item& item) {
    const b2Vec2 velocity = item.body->GetLinearVelocity();
    const bool isFree = velocity == item.given && item.body->GetAngularVelocity() == item.givenTurn;
    if (!isFree) item.isDisturbed = true;
  }

  /// Where the engine brought a body.
  static void follow(Item& item) {
    const b2Vec2 moved = item.body->GetPosition() - item.before;
    item.pose.x += static_cast<double>(moved.x);
    item.pose.y += static_cast<double>(moved.y);
    item.pose.theta =
        wrapAngle(item.pose.theta + static_cast<double>(item.body->GetAngle() - item.beforeAngle));
  }

  /// The engine's single precision must not drift away from our double precision.
  void synchronize(Item& item) {
    const b2Vec2 is = item.body->GetPosition();
    const double away =
        std::max({std::abs(static_cast<double>(is.x) - item.pose.x),
                  std::abs(static_cast<double>(is.y) - item.pose.y),
                  std::abs(static_cast<double>(item.body->GetAngle()) - item.pose.theta)});
    if (away > kDrift)
      item.body->SetTransform({single(item.pose.x), single(item.pose.y)}, single(item.pose.theta));
  }

  /// Whether nothing can touch anything in this step: all bodies had room around them, and none has
  /// used up its half of it. Then the engine has nothing to do.
  bool isFlight(double dt) {
    if (!hasRoom) return false;
    for (Item& item : items) {
      if (item.body == nullptr) continue;
      item.roamed += dt * (static_cast<double>(item.given.Length()) +
                           std::abs(static_cast<double>(item.givenTurn)) * item.reach);
      if (item.roamed > kRoom / 2.0) return hasRoom = false;
    }
    return isFlying = true;
  }

  /// Moves a body with its velocity.
  static void fly(Item& item, double dt) {
    const Point2 arm = rotated(item.centre, item.pose.theta);
    const double theta = item.pose.theta + static_cast<double>(item.givenTurn) * dt;
    const Point2 newArm = rotated(item.centre, theta);
    item.pose.x += static_cast<double>(item.given.x) * dt + arm.x - newArm.x;
    item.pose.y += static_cast<double>(item.given.y) * dt + arm.y - newArm.y;
    item.pose.theta = wrapAngle(theta);
  }

  /// Tells the engine where bodies flew to.
  void land() {
    if (!isFlying) return;
    isFlying = false;
    for (Item& item : items) {
      if (item.body == nullptr) continue;
      item.body->SetTransform({single(item.pose.x), single(item.pose.y)}, single(item.pose.theta));
      item.before = item.body->GetPosition();
      item.beforeAngle = item.body->GetAngle();
    }
  }

  /// Looks whether all bodies have room around them.
  void lookForRoom();
  /// Something changed by hand: nothing is known of room any more.
  void wake() {
    land();
    hasRoom = false;
  }

  /// Velocity of the body's origin.
  Twist velocityOf(const Item& item) const {
    const b2Vec2 v = item.body->GetLinearVelocity();
    const double turn = static_cast<double>(item.body->GetAngularVelocity());
    const bool isCentral = item.centre.x == 0.0 && item.centre.y == 0.0;
    const Point2 arm = isCentral ? Point2{} : rotated(item.centre, item.pose.theta);
    return {static_cast<double>(v.x) + turn * arm.y, static_cast<double>(v.y) - turn * arm.x, turn};
  }

  PhysicsConfig config;
  HeightFilter filter;
  Bouncing bouncing;
  b2World world;
  b2Body* ground = nullptr;
  Heights fence;
  std::vector<std::unique_ptr<Heights>> fixedHeights;  ///< of what does not move
  std::vector<Item> items;
  bool hasRoom = false;
  bool isFlying = false;  ///< the engine does not know yet where bodies are
  int patience = 0;       ///< steps until it is worth looking for room
};

namespace {

const Heights& heightsOf(const b2Fixture& fixture) {
  return *reinterpret_cast<const Heights*>(const_cast<b2Fixture&>(fixture).GetUserData().pointer);
}

bool overlap(const Heights& a, const Heights& b) { return a.low < b.high && b.low < a.high; }

bool HeightFilter::ShouldCollide(b2Fixture* a, b2Fixture* b) {
  return overlap(heightsOf(*a), heightsOf(*b));
}

void Bouncing::BeginContact(b2Contact* contact) {
  const auto& a = heightsOf(*contact->GetFixtureA()).restitution;
  const auto& b = heightsOf(*contact->GetFixtureB()).restitution;
  if (!a && !b) return;
  contact->SetRestitution(single(a && b ? std::min(*a, *b) : a.value_or(b.value_or(0.0))));
}

/// Looks for a fixture that one of some shapes at a place touches.
class Overlap : public b2QueryCallback {
 public:
  Overlap(const b2Shape& shape, const Heights& heights, const b2Transform& place,
          const b2Body* self)
      : shape_(shape), heights_(heights), place_(place), self_(self) {}
  bool ReportFixture(b2Fixture* fixture) override {
    if (fixture->GetBody() == self_ || !overlap(heights_, heightsOf(*fixture))) return true;
    found_ = b2TestOverlap(fixture->GetShape(), 0, &shape_, 0, fixture->GetBody()->GetTransform(),
                           place_);
    return !found_;
  }
  bool isFound() const { return found_; }

 private:
  const b2Shape& shape_;
  const Heights& heights_;
  b2Transform place_;
  const b2Body* self_;
  bool found_ = false;
};

}  // namespace

namespace {

/// Looks for anything near a body.
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

}  // namespace

void Physics::Engine::lookForRoom() {
  if (world.GetContactCount() > 0 || --patience > 0) return;
  for (Item& item : items) {
    if (item.body == nullptr) continue;
    item.roamed = 0.0;
    const b2Vec2 reach(single(item.reach + kRoom), single(item.reach + kRoom));
    b2AABB box;
    box.lowerBound = item.body->GetPosition() - reach;
    box.upperBound = item.body->GetPosition() + reach;
    Neighbours neighbours(item.body);
    world.QueryAABB(&neighbours, box);
    if (!neighbours.isFound()) continue;
    patience = kPatience;
    return;
  }
  hasRoom = true;
}

Physics::Physics(const PhysicsConfig& config, const Solids& solids)
    : engine_(std::make_unique<Engine>(config)) {
  b2BodyDef definition;
  engine_->ground = engine_->world.CreateBody(&definition);
  engine_->attach(engine_->ground, solids.primitives, engine_->fixedHeights);
  for (const WallSegment& wall : solids.walls) {
    engine_->fixedHeights.push_back(std::make_unique<Heights>(Heights{wall.zLow, wall.zHigh, {}}));
    engine_->attach(engine_->ground, *boxShapeOf(wall), *engine_->fixedHeights.back());
  }
  engine_->addFence(solids.bounds);
}

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
  item = {};
  item.properties = properties;
  b2BodyDef definition;
  definition.type = b2_dynamicBody;
  definition.position = {single(pose.x), single(pose.y)};
  definition.angle = single(pose.theta);
  definition.bullet = properties.isFast;
  definition.allowSleep = false;
  item.body = engine_->world.CreateBody(&definition);
  item.pose = item.planned = pose;
  engine_->attach(item.body, pieces, item.heights);
  engine_->weigh(item, pieces);
  return place;
}

void Physics::reshape(Body body, std::span<const Primitive> pieces) {
  engine_->wake();
  Engine::Item& item = engine_->items[body];
  while (b2Fixture* old = item.body->GetFixtureList()) item.body->DestroyFixture(old);
  item.heights.clear();
  engine_->attach(item.body, pieces, item.heights);
  engine_->weigh(item, pieces);
}

void Physics::remove(Body body) {
  engine_->wake();
  engine_->world.DestroyBody(engine_->items[body].body);
  engine_->items[body] = {};
}

void Physics::place(Body body, const Pose2& pose, const Twist& velocity) {
  engine_->wake();
  Engine::Item& item = engine_->items[body];
  item.pose = item.planned = pose;
  item.body->SetTransform({single(pose.x), single(pose.y)}, single(pose.theta));
  item.body->SetAngularVelocity(single(velocity.theta));
  const Point2 arm = rotated(item.centre, pose.theta);
  item.body->SetLinearVelocity(
      {single(velocity.x - velocity.theta * arm.y), single(velocity.y + velocity.theta * arm.x)});
}

void Physics::want(Body body, const Pose2& change) {
  Engine::Item& item = engine_->items[body];
  item.planned = item.pose * change;
}

void Physics::hit(Body body, const Point2& impulse, const Point2& point) {
  engine_->wake();
  engine_->items[body].body->ApplyLinearImpulse(vec(impulse), vec(point), true);
}

bool Physics::isFree(std::span<const Primitive> pieces, const Pose2& pose, Body self) const {
  engine_->land();
  const b2Transform place({single(pose.x), single(pose.y)}, b2Rot(single(pose.theta)));
  const b2Body* own = self == kNobody ? nullptr : engine_->items[self].body;
  for (const Primitive& piece : pieces) {
    const Heights heights{piece.zLow, piece.zHigh, {}};
    for (const auto& shape : boxShapesOf(piece)) {
      b2AABB box;
      shape->ComputeAABB(&box, place, 0);
      Overlap overlap(*shape, heights, place, own);
      engine_->world.QueryAABB(&overlap, box);
      if (overlap.isFound()) return false;
    }
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
        if (static_cast<double>(output.distance) <= reach) return true;
      }
    }
  }
  return false;
}

void Physics::step(double dt) {
  for (Engine::Item& item : engine_->items) {
    if (item.body == nullptr) continue;
    item.isDisturbed = false;
    item.before = item.body->GetPosition();
    item.beforeAngle = item.body->GetAngle();
    if (item.properties.floor != Floor::drives) continue;
    const bool isCentral = item.centre.x == 0.0 && item.centre.y == 0.0;
    const Point2 from = isCentral ? Point2{} : rotated(item.centre, item.pose.theta);
    const Point2 to = isCentral ? Point2{} : rotated(item.centre, item.planned.theta);
    item.wanted = {single((item.planned.x + to.x - item.pose.x - from.x) / dt),
                   single((item.planned.y + to.y - item.pose.y - from.y) / dt)};
    item.wantedTurn = single(wrapAngle(item.planned.theta - item.pose.theta) / dt);
  }
  const int parts = std::max(1, static_cast<int>(std::ceil(dt / kLongestStep - 1e-9)));
  const double part = dt / parts;
  for (int i = 0; i < parts; ++i) {
    for (Engine::Item& item : engine_->items)
      if (item.body != nullptr) engine_->begin(item, part);
    if (parts == 1 && engine_->isFlight(part)) break;
    engine_->land();
    engine_->world.Step(single(part), kVelocityIterations, kPositionIterations);
    for (Engine::Item& item : engine_->items)
      if (item.body != nullptr) engine_->end(item);
  }
  const bool isFlying = engine_->isFlying;
  for (Engine::Item& item : engine_->items) {
    if (item.body == nullptr) continue;
    const bool drives = item.properties.floor == Floor::drives;
    if (drives && !item.isDisturbed)
      item.pose = item.planned;
    else if (isFlying)
      Engine::fly(item, dt);
    else
      Engine::follow(item);
    item.planned = item.pose;
    if (!isFlying) engine_->synchronize(item);
  }
  if (!isFlying) engine_->lookForRoom();
}

const Pose2& Physics::pose(Body body) const { return engine_->items[body].pose; }
Twist Physics::velocity(Body body) const { return engine_->velocityOf(engine_->items[body]); }
double Physics::mass(Body body) const { return engine_->items[body].properties.mass; }
double Physics::inertia(Body body) const { return engine_->items[body].inertia; }
Point2 Physics::centreOfMass(Body body) const {
  const Engine::Item& item = engine_->items[body];
  const Point2 arm = rotated(item.centre, item.pose.theta);
  return {item.pose.x + arm.x, item.pose.y + arm.y};
}
bool Physics::wasDisturbed(Body body) const { return engine_->items[body].isDisturbed; }

}  // namespace ortung

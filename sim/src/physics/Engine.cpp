#include "Engine.hpp"

#include <algorithm>
#include <cmath>

#include "ortung/base/Angles.hpp"

namespace ortung {
namespace {

constexpr int32 kVelocityIterations = 8;
constexpr int32 kPositionIterations = 3;
/// Longest step of the engine [s]; longer ones are divided.
constexpr double kLongestStep = 0.02;
/// Distance that a body travels in a part at most [m]; the engine allows 0.25.
constexpr double kFarthestStep = 0.125;
/// Greatest number of parts, to limit the cost: enough for 100 m/s at 10 ms.
constexpr int kMostParts = 8;
/// Tolerated deviation of the engine's single precision from ours [m], [rad].
constexpr double kDrift = 2e-5;
constexpr float kStill = 1e-4f;  ///< velocities below are the engine's rounding errors

/// Returns @p value moved towards 0 by at most @p step.
double braked(double value, double step) {
  return value > 0.0 ? std::max(value - step, 0.0) : std::min(value + step, 0.0);
}

bool isSame(const b2Vec2& a, const b2Vec2& b, float tolerance) {
  return std::abs(a.x - b.x) <= tolerance && std::abs(a.y - b.y) <= tolerance;
}

}  // namespace

Point2 Physics::Engine::Item::arm(double heading) const {
  if (centre.x == 0.0 && centre.y == 0.0) return {};
  const double c = std::cos(heading);
  const double s = std::sin(heading);
  return {c * centre.x - s * centre.y, s * centre.x + c * centre.y};
}

bool Physics::Engine::Item::goesAsPlanned() const {
  return properties.floor == Floor::kDrives && !isDisturbed;
}

/// Accelerates a body to its wanted velocity, as far as its wheels have grip.
void Physics::Engine::drive(Item& item, double dt) const {
  const double grip =
      kScale * config.floorFriction * kGravity * dt;  // change of velocity in engine units
  const b2Vec2 is = item.body->GetLinearVelocity();
  const b2Vec2 missing = item.wanted - is;
  const double needed = static_cast<double>(missing.Length());
  item.given = item.wanted;
  if (needed > grip) {
    item.given = is + single(grip / needed) * missing;
    item.isDisturbed = true;
  }
  item.freeGrip = std::max(grip - needed, 0.0) / dt;
  // Wheels are at about 0.7 of the body's radius, and all of them contribute to turning.
  const double turnGrip =
      config.floorFriction * kGravity * dt * item.properties.mass * 0.7 * item.reach / item.inertia;
  const double isTurn = static_cast<double>(item.body->GetAngularVelocity());
  const double missingTurn = static_cast<double>(item.wantedTurn) - isTurn;
  item.givenTurn = item.wantedTurn;
  if (std::abs(missingTurn) > turnGrip) {
    item.givenTurn = single(isTurn + std::copysign(turnGrip, missingTurn));
    item.isDisturbed = true;
  }
  item.freeTurnGrip = std::max(turnGrip - std::abs(missingTurn), 0.0) / dt;
}

/// Decelerates a body: a rolling ball little, a sliding body much.
void Physics::Engine::brake(Item& item, double dt) const {
  const bool rolls = item.properties.floor == Floor::kRolls;
  const double friction = rolls ? config.rollingResistance : config.floorFriction;
  const double step = friction * kGravity * dt;
  const b2Vec2 is = item.body->GetLinearVelocity();
  const double speed = static_cast<double>(is.Length());
  item.given = speed > 0.0 ? single(braked(speed, kScale * step) / speed) * is : is;
  // Friction that is uniform over a disc of radius r has a torque of 2/3 mu m g r.
  const double turnStep = step * item.properties.mass * 2.0 / 3.0 * item.reach / item.inertia;
  item.givenTurn = single(braked(static_cast<double>(item.body->GetAngularVelocity()), turnStep));
}

void Physics::Engine::plan(Item& item, double dt) {
  if (item.properties.floor == Floor::kDrives)
    drive(item, dt);
  else
    brake(item, dt);
}

/// Passes velocities to the engine. Sliding bodies are left out: the engine brakes them by the
/// joint that holds them to the floor.
void Physics::Engine::launch(Item& item) const {
  if (item.properties.floor == Floor::kSlides) return;
  item.body->SetLinearVelocity(item.given);
  item.body->SetAngularVelocity(item.givenTurn);
  if (item.properties.floor != Floor::kDrives) return;
  item.floor->SetLinearVelocity(item.given);
  item.floor->SetAngularVelocity(item.givenTurn);
  item.grip->SetMaxForce(single(item.properties.mass * item.freeGrip));
  item.grip->SetMaxTorque(single(kScale * kScale * item.inertia * item.freeTurnGrip));
}

void Physics::Engine::end(Item& item) const {
  const b2Vec2 velocity = item.body->GetLinearVelocity();
  const float turn = item.body->GetAngularVelocity();
  if (item.properties.floor == Floor::kSlides) {
    if (config.floorFriction == 0.0) return;
    if (isSame(velocity, {0.0f, 0.0f}, kStill)) item.body->SetLinearVelocity({0.0f, 0.0f});
    if (std::abs(turn) <= kStill) item.body->SetAngularVelocity(0.0f);
    return;
  }
  if (isSame(velocity, item.given, kStill) && std::abs(turn - item.givenTurn) <= kStill) return;
  item.isDisturbed = true;
}

/// Takes over the pose that the engine computed.
void Physics::Engine::follow(Item& item) {
  const b2Vec2 moved = item.body->GetPosition() - item.before;
  item.pose.x += toMetres(moved.x);
  item.pose.y += toMetres(moved.y);
  item.pose.theta =
      wrapAngle(item.pose.theta + static_cast<double>(item.body->GetAngle() - item.beforeAngle));
}

/// Corrects the engine's single precision if it has drifted from our double precision.
void Physics::Engine::synchronize(Item& item) const {
  const b2Vec2 is = item.body->GetPosition();
  const double away =
      std::max({std::abs(toMetres(is.x) + middle.x - item.pose.x),
                std::abs(toMetres(is.y) + middle.y - item.pose.y),
                std::abs(static_cast<double>(item.body->GetAngle()) - item.pose.theta)});
  if (away > kDrift) transform(item);
}

/// Returns the number of parts of a step: none is too long, and no body travels too far in one.
int Physics::Engine::partsOf(double dt) const {
  double fastest = 0.0;
  for (const Item& item : items)
    if (item.body != nullptr)
      fastest = std::max(fastest, toMetres(item.body->GetLinearVelocity().Length()));
  const double parts = std::max(1.0, std::ceil(dt / kLongestStep - 1e-9));
  return static_cast<int>(
      std::clamp(std::ceil(fastest * dt / kFarthestStep), parts, parts * kMostParts));
}

void Physics::Engine::step(double dt) {
  for (Item& item : items) {
    if (item.body == nullptr) continue;
    item.isDisturbed = false;
    item.before = item.body->GetPosition();
    item.beforeAngle = item.body->GetAngle();
    if (item.properties.floor != Floor::kDrives) continue;
    const Point2 from = item.arm(item.pose.theta);
    const Point2 to = item.arm(item.planned.theta);
    item.wanted = toEngine({(item.planned.x + to.x - item.pose.x - from.x) / dt,
                            (item.planned.y + to.y - item.pose.y - from.y) / dt});
    item.wantedTurn = single(wrapAngle(item.planned.theta - item.pose.theta) / dt);
  }
  const int parts = partsOf(dt);
  bool needsEngine = false;
  for (int i = 0; i < parts; ++i) needsEngine = move(dt / parts, i, parts);
  for (Item& item : items) {
    if (item.body == nullptr) continue;
    if (item.goesAsPlanned()) {
      item.body->SetLinearVelocity(item.given);
      item.body->SetAngularVelocity(item.givenTurn);
      item.pose = item.planned;
    } else if (!item.isFlying) {
      follow(item);
    }
    item.planned = item.pose;
    if (!item.isFlying) synchronize(item);
  }
  if (likeVersion02 && needsEngine) lookForRoom();
}

/// Moves everything on by one of some parts of a step. @returns whether that needed the engine
bool Physics::Engine::move(double dt, int part, int parts) {
  for (Item& item : items)
    if (item.body != nullptr) plan(item, dt);
  const bool needsEngine =
      likeVersion02 ? parts > 1 || !flyTogether(dt) : chooseFlying(dt, part == 0);
  if (needsEngine) {
    if (likeVersion02) land();
    for (Item& item : items)
      if (item.body != nullptr && !item.isFlying) launch(item);
    filter.count(world);
    bouncing.begin(dt);
    stock.forContacts(world);
    world.Step(single(dt), kVelocityIterations, kPositionIterations);
  }
  for (Item& item : items) {
    if (item.body == nullptr) continue;
    if (!item.isFlying) {
      end(item);
    } else if (part + 1 < parts || !item.goesAsPlanned()) {
      fly(item, dt);
      item.body->SetLinearVelocity(item.given);
      item.body->SetAngularVelocity(item.givenTurn);
    }
  }
  return needsEngine;
}

/// Returns the velocity of the body's origin.
Twist Physics::Engine::velocityOf(const Item& item) const {
  const b2Vec2 v = item.body->GetLinearVelocity();
  const double turn = static_cast<double>(item.body->GetAngularVelocity());
  const Point2 arm = item.arm(item.pose.theta);
  return {toMetres(v.x) + turn * arm.y, toMetres(v.y) - turn * arm.x, turn};
}

}  // namespace ortung

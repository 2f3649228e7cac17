#pragma once

#include <box2d/box2d.h>

#include <map>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "Contacts.hpp"
#include "EngineUnits.hpp"
#include "Physics.hpp"

namespace ortung {

/// The physics engine's world. Lengths and velocities in b2 types are in its units, measured from
/// the middle of the field; all else is in SI units in the field frame.
struct Physics::Engine {
  struct Item {
    b2Body* body = nullptr;  ///< null: the place is free
    Properties properties;
    double reach = 0.0;         ///< of its shape from its origin [m]
    double inertia = 0.0;       ///< [kg m^2]
    Point2 centre;              ///< of mass, in its own frame [m]
    Pose2 pose;                 ///< in double precision
    Pose2 planned;              ///< where a driving body will be if nothing is in the way
    b2Vec2 wanted{0.0f, 0.0f};  ///< velocity of the centre of mass
    float wantedTurn = 0.0f;    ///< [rad/s]
    b2Vec2 given{0.0f, 0.0f};   ///< velocity with which it goes into the engine's step
    float givenTurn = 0.0f;
    b2Vec2 before{0.0f, 0.0f};  ///< position before the engine's step
    float beforeAngle = 0.0f;
    double roamed = 0.0;  ///< what its farthest point may have moved since there was room [m]
    bool isDisturbed = false;
    int rest = 0;  ///< tries to change shape in which it pushes nothing away, for the last failed
    b2Body* floor = nullptr;          ///< moves as the wheels turn; stands still under what slides
    b2FrictionJoint* grip = nullptr;  ///< between body and floor; none of a ball
    double freeGrip = 0.0;  ///< that driving leaves over to hold against pushes: an acceleration
    double freeTurnGrip = 0.0;                      ///< [rad/s^2]
    std::unique_ptr<Crowd> crowd;                   ///< stays where it is, for the engine
    std::vector<std::unique_ptr<Heights>> heights;  ///< of its shapes

    /// From its origin to its centre of mass if it has this heading, in the field [m].
    Point2 arm(double heading) const;
  };

  explicit Engine(const PhysicsConfig& config, const Solids& solids);

  // --- bodies: EngineBodies.cpp
  void attach(b2Body* body, std::span<const Primitive> pieces,
              std::vector<std::unique_ptr<Heights>>& kept, const Point2& origin = {}) const;
  void attach(b2Body* body, const b2Shape& shape, Heights& range,
              const std::optional<double>& friction = {}) const;
  void addSolids(const Solids& solids);
  void addFence(const Box2& bounds);
  b2Body* groundAt(const Point2& place, Point2& origin);
  void create(Item& item, std::span<const Primitive> pieces);
  void weigh(Item& item, std::span<const Primitive> pieces);
  void holdOn(Item& item);
  void destroy(Item& item);

  // --- room for other shapes: EngineRoom.cpp
  bool isFree(const b2Body& body, const b2Transform& at) const;
  bool findObstacles(const Item& item, std::span<const Primitive> added, std::vector<Item*>& found);
  using Fresh = std::vector<std::unique_ptr<Heights>>;  ///< of shapes that are new
  bool isOpen(const Item& thing, const b2Vec2& way, const Fresh& fresh) const;
  std::optional<b2Vec2> wayOut(const Item& thing, const Item& from, const Fresh& fresh) const;
  Item& itemOf(const b2Body* body);
  bool pushOut(const Item& item, const Fresh& fresh, std::span<Item* const> things);

  // --- a step: Engine.cpp
  void step(double dt);
  int partsOf(double dt) const;
  void drive(Item& item, double dt) const;
  void brake(Item& item, double dt) const;
  void plan(Item& item, double dt);
  void launch(Item& item) const;
  void end(Item& item) const;
  static void follow(Item& item);
  static void fly(Item& item, double dt);
  void synchronize(Item& item) const;
  bool isFlight(double dt);
  void land();
  void lookForRoom();
  /// Something changed by hand: nothing is known of room any more.
  void wake() {
    land();
    hasRoom = false;
  }
  Twist velocityOf(const Item& item) const;

  b2Vec2 positionOf(const Pose2& pose) const {
    return toEngine({pose.x - middle.x, pose.y - middle.y});
  }
  void transform(Item& item) const {
    item.body->SetTransform(positionOf(item.pose), single(item.pose.theta));
  }

  PhysicsConfig config;
  Point2 middle;  ///< of the field, where the engine has its origin [m]
  HeightFilter filter;
  Bouncing bouncing;
  b2World world;
  b2Body* ground = nullptr;
  std::map<std::pair<int, int>, b2Body*> tiles;  ///< of the ground, with origins of their own
  Heights fence;
  std::vector<std::unique_ptr<Heights>> fixedHeights;  ///< of what does not move
  std::vector<Item> items;
  bool hasRoom = false;
  bool isFlying = false;  ///< the engine does not know yet where bodies are
  int patience = 0;       ///< steps until it is worth looking for room
};

}  // namespace ortung

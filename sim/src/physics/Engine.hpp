#pragma once

#include <box2d/box2d.h>

#include <map>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "BlockStock.hpp"
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
    double reach = 0.0;         ///< greatest distance of its shape from its origin [m]
    double inertia = 0.0;       ///< moment of inertia around its centre of mass [kg m^2]
    Point2 centre;              ///< centre of mass in its own frame [m]
    Pose2 pose;                 ///< pose in double precision
    Pose2 planned;              ///< pose of a driving body after the step if nothing is in the way
    b2Vec2 wanted{0.0f, 0.0f};  ///< wanted velocity of the centre of mass
    float wantedTurn = 0.0f;    ///< wanted turn rate [rad/s]
    b2Vec2 given{0.0f, 0.0f};   ///< velocity before the engine's step
    float givenTurn = 0.0f;
    b2Vec2 before{0.0f, 0.0f};  ///< position before the engine's step
    float beforeAngle = 0.0f;
    bool isFlying = false;  ///< whether it moves without the engine
    bool isNear = false;    ///< whether another moving body may touch it in this step
    double way = 0.0;       ///< upper bound of its points' motion in this step [m]
    double room = 0.0;      ///< free space around it when that was looked for last [m]
    double roamed = 0.0;    ///< upper bound of its points' motion since then [m]
    int patience = 0;       ///< steps until its free space is looked for again
    bool isDisturbed = false;
    int rest = 0;  ///< remaining changes of shape for which pushing is not tried, since it failed
    b2Body* floor = nullptr;  ///< moves as the wheels turn; is stationary under sliding bodies
    b2FrictionJoint* grip = nullptr;  ///< joint between body and floor; none for a ball
    /// Acceleration that is left of the grip to resist pushes, in engine units.
    double freeGrip = 0.0;
    double freeTurnGrip = 0.0;     ///< angular acceleration that is left of the grip [rad/s^2]
    std::unique_ptr<Crowd> crowd;  ///< its contacts; the engine keeps a pointer to it
    std::vector<std::unique_ptr<Heights>> heights;  ///< heights of its shapes

    /// Returns the vector from its origin to its centre of mass at this heading, in the field frame
    /// [m].
    Point2 arm(double heading) const;
    /// Returns whether nothing has kept it from moving as its drive wants.
    bool goesAsPlanned() const;
  };
  /// A circle around a body, and its left end [m].
  struct Disc {
    double left = 0.0, x = 0.0, y = 0.0, radius = 0.0;
    Item* item = nullptr;
  };

  Engine(const PhysicsConfig& config, const Solids& solids, bool isLikeVersion02);

  // --- bodies: EngineBodies.cpp
  b2Body* make(const b2BodyDef& definition);
  void attach(b2Body* body, std::span<const Primitive> pieces,
              std::vector<std::unique_ptr<Heights>>& kept, const Point2& origin = {});
  void attach(b2Body* body, const b2Shape& shape, Heights& range,
              const std::optional<double>& friction = {});
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
  using Fresh = std::vector<std::unique_ptr<Heights>>;  ///< heights of new shapes
  bool isOpen(const Item& thing, const b2Vec2& way, const Fresh& fresh) const;
  std::optional<b2Vec2> wayOut(const Item& thing, const Item& from, const Fresh& fresh) const;
  Item& itemOf(const b2Body* body);
  bool pushOut(const Item& item, const Fresh& fresh, std::span<Item* const> things);

  // --- a step: Engine.cpp
  void step(double dt);
  bool move(double dt, int part, int parts);
  int partsOf(double dt) const;
  void drive(Item& item, double dt) const;
  void brake(Item& item, double dt) const;
  void plan(Item& item, double dt);
  void launch(Item& item) const;
  void end(Item& item) const;
  static void follow(Item& item);
  void synchronize(Item& item) const;
  Twist velocityOf(const Item& item) const;

  // --- bodies that nothing is near: EngineFlight.cpp
  static void fly(Item& item, double dt);
  bool chooseFlying(double dt, bool isFirst);
  void findNear(double distance);
  bool hasRoom(Item& item, double distance);
  static void takeOff(Item& item);
  static void setEnabled(Item& item, bool isEnabled);
  void land(Item& item);
  void land();
  Point2 placeOf(const Item& item) const;
  bool flyTogether(double dt);
  void lookForRoom();
  /// Resets the free-space test after something was changed from outside.
  void wake() {
    land();
    canAllFly = false;
  }

  b2Vec2 positionOf(const Pose2& pose) const {
    return toEngine({pose.x - middle.x, pose.y - middle.y});
  }
  void transform(Item& item) const {
    item.body->SetTransform(positionOf(item.pose), single(item.pose.theta));
  }

  PhysicsConfig config;
  Point2 middle;  ///< middle of the field, where the engine has its origin [m]
  HeightFilter filter;
  Bouncing bouncing;
  BlockStock stock;  ///< memory of what is in the world
  b2World world;
  b2Body* ground = nullptr;
  std::map<std::pair<int, int>, b2Body*> tiles;  ///< parts of the ground, with origins of their own
  Heights fence;
  std::vector<std::unique_ptr<Heights>> fixedHeights;  ///< heights of the fixed shapes
  std::vector<Item> items;
  bool likeVersion02;         ///< whether all bodies fly, or none, and all that touch are swept
  bool canAllFly = false;     ///< whether all had free space around them
  int patience = 0;           ///< steps until free space is looked for again
  std::vector<Disc> inOrder;  ///< all bodies, from left to right
};

}  // namespace ortung

#pragma once

#include <box2d/box2d.h>

#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace ortung {

/// What the engine keeps with every shape.
struct Heights {
  double low = 0.0, high = 0.0;       ///< [m]
  std::optional<double> restitution;  ///< of its own
};
bool overlap(const Heights& a, const Heights& b);
const Heights& heightsOf(const b2Fixture& fixture);

/// What the engine keeps with every body that moves.
struct Crowd {
  // Pairs of its shapes and others' that the engine looks at:
  int withGround = 0;
  int withMoving = 0;
};

/// Bodies meet where their heights overlap. One body has a limited number of contacts, so that no
/// shapes, however many pieces they have, hold up the world: those with many get into each other.
class HeightFilter : public b2ContactFilter {
 public:
  /// To be called before each step of the engine, which may make contacts.
  void count(b2World& world);
  bool ShouldCollide(b2Fixture* a, b2Fixture* b) override;
};

/// Says how much two bodies bounce: as the one says that has a restitution of its own, or as the
/// one says that bounces less.
class Bouncing : public b2ContactListener {
 public:
  void BeginContact(b2Contact* contact) override;
};

/// Looks for bodies that a shape at a place touches.
class Touching : public b2QueryCallback {
 public:
  /// @param self is not looked at
  /// @param isOneEnough whether to end at the first
  Touching(const b2Shape& shape, const Heights& heights, const b2Transform& place,
           const b2Body* self, bool isOneEnough = true);
  bool ReportFixture(b2Fixture* fixture) override;
  const std::vector<b2Body*>& found() const { return found_; }
  /// Asks the world.
  bool lookIn(const b2World& world);

 private:
  const b2Shape& shape_;
  const Heights& heights_;
  b2Transform place_;
  const b2Body* self_;
  bool isOneEnough_;
  std::vector<b2Body*> found_;
};

/// Looks for anything near a body.
class Neighbours : public b2QueryCallback {
 public:
  explicit Neighbours(const b2Body* self) : self_(self) {}
  bool ReportFixture(b2Fixture* fixture) override;
  bool isFound() const { return found_; }

 private:
  const b2Body* self_;
  bool found_ = false;
};

/// Looks for anything between two points but a body and new shapes of another one.
class Barrier : public b2RayCastCallback {
 public:
  Barrier(const Heights& heights, const b2Body* self,
          std::span<const std::unique_ptr<Heights>> fresh)
      : heights_(heights), self_(self), fresh_(fresh) {}
  float ReportFixture(b2Fixture* fixture, const b2Vec2& point, const b2Vec2& normal,
                      float fraction) override;
  bool isFound() const { return found_; }

 private:
  const Heights& heights_;
  const b2Body* self_;
  std::span<const std::unique_ptr<Heights>> fresh_;
  bool found_ = false;
};

}  // namespace ortung

#pragma once

#include <box2d/box2d.h>

#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace ortung {

/// The data that the engine keeps with every shape.
struct Heights {
  double low = 0.0, high = 0.0;       ///< heights of bottom and top [m]
  std::optional<double> restitution;  ///< the shape's own restitution; none: the world's
};
bool overlap(const Heights& a, const Heights& b);
const Heights& heightsOf(const b2Fixture& fixture);

/// The data that the engine keeps with every moving body.
struct Crowd {
  // Pairs of its shapes and others' that the engine looks at:
  int withGround = 0;
  int withMoving = 0;
};

/// Lets bodies collide where their heights overlap. The number of contacts of a body is limited, so
/// that bodies of many pieces can't slow down the simulation; beyond the limit they penetrate each
/// other.
class HeightFilter : public b2ContactFilter {
 public:
  /// Counts the contacts of all bodies; to be called before each step of the engine, which may make
  /// contacts.
  void count(b2World& world);
  bool ShouldCollide(b2Fixture* a, b2Fixture* b) override;
};

/// Sets the restitution of a contact: that of the body with a restitution of its own, or the
/// smaller one. Leaves those out of the sweep in which the solver has ended the approach: there the
/// sweep finds an impact at once, again and again, and the longer it tries, the deeper is the
/// overlap of those behind it.
class Bouncing : public b2ContactListener {
 public:
  /// @param sweepsAll whether contacts are swept whatever the solver did
  explicit Bouncing(bool sweepsAll) : sweepsAll_(sweepsAll) {}
  /// Tells the length of the engine's next step [s].
  void begin(double dt) { dt_ = dt; }
  void BeginContact(b2Contact* contact) override;
  void PostSolve(b2Contact* contact, const b2ContactImpulse* impulse) override;

 private:
  bool sweepsAll_;
  double dt_ = 0.0;
};

/// Finds the bodies that a shape at a place touches.
class Touching : public b2QueryCallback {
 public:
  /// @param self the body that is ignored
  /// @param isOneEnough whether the search ends at the first body
  Touching(const b2Shape& shape, const Heights& heights, const b2Transform& place,
           const b2Body* self, bool isOneEnough = true);
  bool ReportFixture(b2Fixture* fixture) override;
  const std::vector<b2Body*>& found() const { return found_; }
  /// Searches the world. @returns whether a body was found
  bool lookIn(const b2World& world);

 private:
  const b2Shape& shape_;
  const Heights& heights_;
  b2Transform place_;
  const b2Body* self_;
  bool isOneEnough_;
  std::vector<b2Body*> found_;
};

/// Tests whether anything is between two points, ignoring one body and the new shapes of another
/// one.
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

#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "ortung/base/Pose2.hpp"
#include "ortung/sim/PhysicsConfig.hpp"
#include "ortung/sim/Solids.hpp"

namespace ortung {

/// Rigid bodies in the plane (paper, section 2.1). This folder alone knows the physics engine.
/// Bodies meet where their ranges of height overlap. Impacts obey eqs. (1) to (5) at every speed;
/// friction lies between none and sticking. Not thread-safe.
class Physics {
 public:
  /// How a body holds on to the floor.
  enum class Floor {
    rolls,   ///< a ball
    slides,  ///< a crate
    drives   ///< a robot: goes where it wants as far as its wheels have grip
  };
  struct Properties {
    double mass = 1.0;  ///< [kg]
    Floor floor = Floor::slides;
  };
  using Body = std::size_t;

  Physics(const PhysicsConfig& config, const Solids& solids);
  ~Physics();
  Physics(const Physics&) = delete;
  Physics& operator=(const Physics&) = delete;

  Body add(std::span<const Primitive> pieces, const Properties& properties, const Pose2& pose);
  /// Another shape of the same mass, where it has room. What rolls or slides and is in the way is
  /// pushed aside; what drives or stands fast is not.
  /// @param added those of the pieces that may run into something
  /// @returns whether it has the shape now; if not, nothing was changed
  bool reshape(Body body, std::span<const Primitive> pieces, std::span<const Primitive> added);
  /// The body's place is used for another one later on.
  void remove(Body body);
  /// Puts a body somewhere, with this velocity in the field frame.
  void place(Body body, const Pose2& pose, const Twist& velocity = {});

  /// What a driving body wants to do in the next step: a change of pose in its own old frame.
  void want(Body body, const Pose2& change);
  /// Hits a body: an impulse [N s] through a point, both in the field frame.
  void hit(Body body, const Point2& impulse, const Point2& point);

  /// Whether pieces at a pose would touch nothing but @p self.
  /// @param self a body, or kNobody
  bool isFree(std::span<const Primitive> pieces, const Pose2& pose, Body self) const;
  /// Whether pieces in a body's frame are within @p reach [m] of another body.
  bool reaches(Body body, std::span<const Primitive> pieces, Body other, double reach) const;

  /// Moves everything on by @p dt [s].
  void step(double dt);

  const Pose2& pose(Body body) const;
  Twist velocity(Body body) const;  ///< of its origin, in the field frame
  double mass(Body body) const;
  double inertia(Body body) const;       ///< around its centre of mass [kg m^2]
  Point2 centreOfMass(Body body) const;  ///< in the field
  /// Whether something kept a driving body from what it wanted.
  bool wasDisturbed(Body body) const;

  static constexpr Body kNobody = static_cast<Body>(-1);

 private:
  struct Engine;
  std::unique_ptr<Engine> engine_;
};

}  // namespace ortung

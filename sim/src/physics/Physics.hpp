#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "ortung/base/Pose2.hpp"
#include "ortung/sim/PhysicsConfig.hpp"
#include "ortung/sim/Solids.hpp"

namespace ortung {

/// Rigid bodies in the plane (paper, section 2.1). Only this folder uses the physics engine. Bodies
/// collide where their ranges of height overlap. Impacts obey eqs. (1) to (5) at every speed;
/// friction lies between none and sticking. Not thread-safe.
class Physics {
 public:
  /// How a body is in contact with the floor.
  enum class Floor {
    kRolls,   ///< a ball
    kSlides,  ///< a crate
    kDrives   ///< a robot: moves as it wants as far as its wheels have grip
  };
  struct Properties {
    double mass = 1.0;  ///< mass [kg]
    Floor floor = Floor::kSlides;
  };
  using Body = std::size_t;

  /// @param likeVersion02 whether bodies move as they did in version 0.2, bit for bit: slower
  Physics(const PhysicsConfig& config, const Solids& solids, bool likeVersion02 = false);
  ~Physics();
  Physics(const Physics&) = delete;
  Physics& operator=(const Physics&) = delete;

  /// Adds a body at a pose in the field frame.
  Body add(std::span<const Primitive> pieces, const Properties& properties, const Pose2& pose);
  /// Gives a body another shape of the same mass, if there is room. Rolling and sliding bodies in
  /// the way are pushed aside; driving and fixed ones are not.
  /// @param added the pieces that may collide with something
  /// @returns whether it has the shape now; if not, nothing was changed
  bool reshape(Body body, std::span<const Primitive> pieces, std::span<const Primitive> added);
  /// Removes a body; its index is reused.
  void remove(Body body);
  /// Moves a body to a pose and gives it a velocity, both in the field frame.
  void place(Body body, const Pose2& pose, const Twist& velocity = {});

  /// Sets the motion that a driving body wants in the next step: a change of pose in its own old
  /// frame.
  void want(Body body, const Pose2& change);
  /// Applies an impulse [N s] at a point, both in the field frame.
  void hit(Body body, const Point2& impulse, const Point2& point);

  /// Returns whether pieces at a pose would touch nothing except @p self.
  /// @param self a body, or kNobody
  bool isFree(std::span<const Primitive> pieces, const Pose2& pose, Body self) const;
  /// Returns whether pieces in a body's frame are within @p reach [m] of another body.
  bool reaches(Body body, std::span<const Primitive> pieces, Body other, double reach) const;

  /// Moves everything on by @p dt [s].
  void step(double dt);

  const Pose2& pose(Body body) const;
  Twist velocity(Body body) const;  ///< velocity of its origin in the field frame
  double mass(Body body) const;
  double inertia(Body body) const;       ///< moment of inertia around its centre of mass [kg m^2]
  Point2 centreOfMass(Body body) const;  ///< centre of mass in the field frame [m]
  /// Returns whether something kept a driving body from its wanted motion.
  bool wasDisturbed(Body body) const;

  static constexpr Body kNobody = static_cast<Body>(-1);

 private:
  struct Engine;
  std::unique_ptr<Engine> engine_;
};

}  // namespace ortung

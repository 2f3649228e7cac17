#pragma once

#include <cmath>
#include <span>

#include "ortung/sim/Primitive.hpp"

namespace ortung {

/// A cone with a level axis, seen from its apex: the axis is x.
struct ConeOverPlan {
  double slope = 0.0;  ///< tangent of the angle between axis and edge

  /// Distance from the apex to the nearest point within the cone of an upright prism [m], or
  /// infinity, in closed form.
  /// @param outline corners of the convex plan, in order, apex at the origin
  /// @param height least difference of height between apex and prism; 0: the apex is level with it
  double nearest(std::span<const Point2> outline, double height) const;
};

}  // namespace ortung

#pragma once

#include <cmath>
#include <span>

#include "ortung/sim/Primitive.hpp"

namespace ortung {

/// A cone with a horizontal axis in the frame of its apex, whose x axis is the cone's axis.
struct ConeOverPlan {
  double slope = 0.0;  ///< tangent of the angle between axis and edge

  /// Returns the distance from the apex to the nearest point of an upright prism within the cone
  /// [m], in closed form; infinity if there is none.
  /// @param outline corners of the convex plan, in order, apex at the origin
  /// @param height least difference of height between apex and prism [m]; 0: the apex is level with
  ///   it
  double nearest(std::span<const Point2> outline, double height) const;
};

}  // namespace ortung

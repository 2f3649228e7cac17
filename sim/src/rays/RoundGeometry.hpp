#pragma once

#include <optional>
#include <vector>

#include "Mesh.hpp"

namespace ortung {

/// A ray in single precision, as the ray tracing library has it, relative to a mesh's middle.
struct FloatRay {
  std::array<float, 3> origin;     ///< origin [m]
  std::array<float, 3> direction;  ///< unit direction
  float from = 0.0f;               ///< distance along it at which it begins [m]
  float to = 0.0f;                 ///< distance along it at which it ends [m]
};

/// Upright elliptic cylinders, intersected in closed form and double precision, not as polygons.
class RoundGeometry {
 public:
  RoundGeometry() = default;
  RoundGeometry(const std::vector<RoundBody>& bodies, const Point2& middle);

  std::size_t size() const { return bodies_.size(); }
  /// Returns the lowest and highest x, y, z relative to the middle [m].
  std::array<std::array<float, 3>, 2> boundsOf(std::size_t body) const;
  /// Returns the distance along the ray to the first surface, from outside or inside [m]; nothing
  /// if it is not between from and to.
  std::optional<float> hit(std::size_t body, const FloatRay& ray) const;

 private:
  /// A body whose base becomes a unit circle by (x, y) |-> (xx x + xy y, yx x + yy y).
  struct Unit {
    double x, y, zLow, zHigh;
    double xx, xy, yx, yy;
    double reachX, reachY;  ///< half the size of its bounding box [m]
  };
  std::vector<Unit> bodies_;
};

}  // namespace ortung

#pragma once

#include <optional>
#include <vector>

#include "Mesh.hpp"

namespace ortung {

/// A ray in single precision, as the ray tracing library knows it, relative to a mesh's middle.
struct FloatRay {
  std::array<float, 3> origin;     ///< [m]
  std::array<float, 3> direction;  ///< of length 1
  float from = 0.0f;               ///< where it begins [m]
  float to = 0.0f;                 ///< where it ends [m]
};

/// Upright elliptic cylinders, met by rays in closed form: neither polygons nor single precision
/// blur them.
class RoundGeometry {
 public:
  RoundGeometry() = default;
  RoundGeometry(const std::vector<RoundBody>& bodies, const Point2& middle);

  std::size_t size() const { return bodies_.size(); }
  /// Lowest and highest x, y, z, relative to the middle.
  std::array<std::array<float, 3>, 2> boundsOf(std::size_t body) const;
  /// Distance along the ray to the first surface, from outside or inside, if it is on the ray.
  std::optional<float> hit(std::size_t body, const FloatRay& ray) const;

 private:
  /// A body in whose own frame, (x, y) |-> (xx x + xy y, yx x + yy y), the base is a unit circle.
  struct Unit {
    double x, y, zLow, zHigh;
    double xx, xy, yx, yy;
    double reachX, reachY;  ///< half the size of its bounds [m]
  };
  std::vector<Unit> bodies_;
};

}  // namespace ortung

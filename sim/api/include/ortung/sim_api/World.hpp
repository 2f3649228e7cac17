#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "ortung/container/Export.hpp"
#include "ortung/container/FieldRegion.hpp"
#include "ortung/container/Pose2.hpp"

namespace ortung {

/// Rays from one point at evenly spaced angles in one plane parallel to the floor.
struct RayFan {
  double x = 0.0;           ///< origin in the field frame [m]
  double y = 0.0;           ///< [m]
  double z = 0.0;           ///< [m]
  double firstAngle = 0.0;  ///< of ray 0 in the field frame [rad]
  double angleStep = 0.0;   ///< [rad]
  double elevation = 0.0;   ///< of all rays above the plane [rad]
  double maxRange = 8.0;    ///< [m]
};

/// Something with an identity that a sensor can recognise, e.g. a corner post.
struct Landmark {
  std::uint32_t identity = 0;  ///< its number within its kind: post 3
  std::string kind;            ///< "post"
  double x = 0.0;              ///< [m]
  double y = 0.0;              ///< [m]
  double z = 0.0;              ///< height at which it is looked at [m]
};

/// Which robot's own body rays ignore; 0: none.
using RobotNumber = std::uint32_t;

/// What a sensor plugin may ask of the world. Embree stays behind it.
/// Queries are thread-safe while nobody moves the world.
class ORTUNG_API World {
 public:
  virtual ~World();

  /// Range of each ray of the fan to the first surface [m], or fan.maxRange where there is none;
  /// ranges.size() is the number of rays.
  virtual void castFan(const RayFan& fan, RobotNumber ignore, std::span<float> ranges) const = 0;

  /// Whether nothing stands between two points at the given heights, but for what lies within
  /// @p slack metres of the second (so that a post does not hide itself).
  virtual bool isVisible(double x0, double y0, double z0, double x1, double y1, double z1,
                         RobotNumber ignore, double slack) const = 0;

  virtual std::span<const Landmark> landmarks() const = 0;

  /// Whether a circle on the floor touches nothing solid and lies within the field.
  virtual bool isFree(double x, double y, double radius) const = 0;
};

}  // namespace ortung

#pragma once

#include <memory>
#include <vector>

#include "ortung/container/Export.hpp"
#include "ortung/container/Pose2.hpp"
#include "ortung/container/Random.hpp"
#include "ortung/container/Time.hpp"
#include "ortung/sim/Drive.hpp"
#include "ortung/sim/RoutePlanner.hpp"

namespace ortung {

/// Decides where a simulated robot goes. It knows the truth, unlike a player.
/// Not thread-safe.
class ORTUNG_API Driver {
 public:
  virtual ~Driver();
  /// Commands @p drive for the cycle that begins.
  /// @param pose true, in the field frame
  virtual void command(const Pose2& pose, Timestamp now, Drive& drive) = 0;
};

/// How fast a driver goes; the drive's own limits hold, too.
struct DriverLimits {
  double speed = 0.8;             ///< [m/s]
  double acceleration = 1.0;      ///< with which it brakes before corners [m/s^2]
  double turn = 2.0;              ///< [rad/s]
  double turnAcceleration = 6.0;  ///< [rad/s^2]

  ORTUNG_API static DriverLimits of(const DriveConfig& drive);
};

/// Drives for ever from one random place to another, preferring where it has not been, and so
/// covers everything it can reach.
/// @param planner borrowed
ORTUNG_API std::unique_ptr<Driver> makeWanderer(const RoutePlanner& planner,
                                                const DriverLimits& limits, const Random& random);

/// Drives straight from point to point and stands still at the last.
ORTUNG_API std::unique_ptr<Driver> makeFollower(std::vector<FloorPoint> points,
                                                const DriverLimits& limits);

}  // namespace ortung

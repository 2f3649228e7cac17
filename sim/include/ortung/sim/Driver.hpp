#pragma once

#include <memory>
#include <vector>

#include "ortung/base/Export.hpp"
#include "ortung/base/Pose2.hpp"
#include "ortung/base/Random.hpp"
#include "ortung/base/Time.hpp"
#include "ortung/sim/RoutePlanner.hpp"
#include "ortung/sim_api/Drive.hpp"

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

/// Drives for ever from one random place to another, preferring where it has not been, and so
/// covers everything it can reach.
/// @param planner borrowed
/// @param limits how fast it goes; the drive's own limits hold, too
ORTUNG_API std::unique_ptr<Driver> makeWanderer(const RoutePlanner& planner,
                                                const DriveLimits& limits, const Random& random);

/// Drives straight from point to point and stands still at the last.
ORTUNG_API std::unique_ptr<Driver> makeFollower(std::vector<FloorPoint> points,
                                                const DriveLimits& limits);

}  // namespace ortung

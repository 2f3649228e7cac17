#pragma once

#include <optional>

#include "ortung/base/Export.hpp"
#include "ortung/base/Pose2.hpp"
#include "ortung/base/Random.hpp"
#include "ortung/motion/MotionModel.hpp"
#include "ortung/tables/FieldRegion.hpp"

namespace ortung {

/// Rides of lifts, of which no odometry tells. A robot that stands in a lift for a while may be at
/// any of its stops a moment later, so some of the samples there ride each time: a jump process
/// that comes to any stop, the same one too, with equal probability. Readings that still show the
/// old floor take these samples out again; a closed cabin leaves them, and the first readings
/// behind the open door say which of them are right. So a ride is a part of the motion, and no
/// search has to find out afterwards that the robot was carried away.
///
/// In a building of whose lifts nobody has told, there may be one wherever a robot stands: it goes
/// to the same place on each floor on which a robot can stand there.
///
/// Thread-safe.
class ORTUNG_API LiftRides {
 public:
  /// @param region borrowed
  explicit LiftRides(const FieldRegion& region) : region_(region) {}

  /// Whether nobody rides: in a field that is no building of several floors.
  bool isEmpty() const { return region_.building.floors.size() < 2; }
  /// Returns whether a place in the field is in a lift.
  bool isInLift(double x, double y) const;
  /// Moves the samples in a lift that may have ridden to the stops where they would be now.
  /// @param seconds time over which the robot stood there, at least 0 @return whether any was moved
  bool ride(const MovableSamples& samples, double seconds, Random random) const;

 private:
  struct Stop {
    const Lift* lift;
    const LiftStop* stop;
  };
  std::optional<Stop> stopAt(double x, double y) const;
  std::optional<Pose2> randomStop(const Pose2& pose, Random& random) const;

  const FieldRegion& region_;
};

}  // namespace ortung

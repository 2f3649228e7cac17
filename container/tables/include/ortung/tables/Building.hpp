#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "ortung/base/Export.hpp"
#include "ortung/base/Pose2.hpp"

namespace ortung {

/// A floor of a building. Floors lie side by side in one field, each in a strip of its own across
/// all of y, so that a pose in the field says on which floor it is: tables, searches, covariances
/// and status need no notion of floors.
struct Floor {
  std::string name;
  double shift = 0.0;  ///< x in the field of the origin of the floor's own frame, its map's [m]
  double xLow = 0.0;   ///< where its strip begins in the field [m]
  double xHigh = 0.0;  ///< where its strip ends in the field, and the next one begins [m]

  /// Returns the pose in the field of a pose in the floor's own frame.
  Pose2 toField(const Pose2& pose) const { return {pose.x + shift, pose.y, pose.theta}; }
  /// Returns the pose in the floor's own frame of a pose in the field.
  Pose2 fromField(const Pose2& pose) const { return {pose.x - shift, pose.y, pose.theta}; }
};

/// Where a lift stops.
struct LiftStop {
  std::size_t floor = 0;  ///< index of the floor
  Pose2 pose;             ///< pose of the cabin's middle in the field
};

/// A lift: a robot that stands in it may be at any of its stops a moment later.
struct Lift {
  std::string name;
  double radius = 1.0;  ///< distance from its middle up to which a robot is in it [m]
  std::vector<LiftStop> stops;
};

/// The floors of a field, and the lifts between them. Most fields are no buildings: they have
/// neither.
struct Building {
  std::vector<Floor> floors;  ///< in the order of x
  std::vector<Lift> lifts;

  bool isEmpty() const { return floors.empty(); }
  /// Returns the index of the floor of a place in the field. @pre !isEmpty(), x is finite
  ORTUNG_API std::size_t floorAt(double x) const;
  /// Returns the floor of a place in the field. @pre !isEmpty(), x is finite
  const Floor& floorOf(double x) const { return floors[floorAt(x)]; }
  /// Returns the index of the floor of a name; nothing: there is none.
  ORTUNG_API std::optional<std::size_t> find(const std::string& name) const;
  /// Checks what a file says. @throws std::invalid_argument naming the floor or lift: strips that
  /// do not follow each other, names that are empty or there twice, numbers that are not finite,
  /// stops on floors that there are not or outside of their strips, and lifts with fewer than two
  /// stops
  ORTUNG_API void check() const;
};

}  // namespace ortung

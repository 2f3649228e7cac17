#pragma once

#include <optional>

#include "ortung/base/Angles.hpp"
#include "ortung/base/Export.hpp"
#include "ortung/sim_api/Sensor.hpp"
#include "ortung/sim_api/World.hpp"

/// Visibility: field of view, range, occlusion.
namespace ortung {

/// An eye of a sensor: its pose, field of view and range.
struct Eye {
  Pose2 pose;                  ///< pose in the field frame; it looks along its x axis
  double z = 0.0;              ///< height above the floor [m]
  double fieldOfView = kTurn;  ///< full opening angle [rad]; 2 pi: it sees all around
  double minRange = 0.0;       ///< least distance of what it sees, along the floor [m]
  double maxRange = 20.0;      ///< greatest distance of what it sees, along the floor [m]
  RobotNumber robot = 0;       ///< the robot that carries it, whose body does not occlude
};

/// The place of something in a sensor's frame.
struct Sighting {
  double range = 0.0;    ///< distance along the floor [m]
  double bearing = 0.0;  ///< angle from the sensor's x axis [rad], in (-pi, pi]
};

/// Returns range and bearing of a point (x, y) of the field frame, or nothing if it is out of the
/// field of view or out of range. It does not test occlusion.
ORTUNG_API std::optional<Sighting> lookAt(const Eye& eye, double x, double y);

/// Returns whether the line of sight from the eye to a point [m] is free, ignoring everything
/// within @p slack [m] of the point.
ORTUNG_API bool isVisible(const World& world, const Eye& eye, double x, double y, double z,
                          double slack);

/// Returns the visible share of a body's width as seen from the eye, in [0, 1]: lines of sight go
/// to its near side, at half its height. Field of view and range are not tested.
ORTUNG_API double visibleShare(const World& world, const Eye& eye, const WorldObject& object);

}  // namespace ortung

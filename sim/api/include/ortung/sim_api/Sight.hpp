#pragma once

#include <optional>

#include "ortung/base/Angles.hpp"
#include "ortung/base/Export.hpp"
#include "ortung/sim_api/Sensor.hpp"
#include "ortung/sim_api/World.hpp"

/// What is visible: field of view, range, occlusion.
namespace ortung {

/// Something that looks: where it is and how far it sees.
struct Eye {
  Pose2 pose;                  ///< in the field frame, looking along its x axis
  double z = 0.0;              ///< above the floor [m]
  double fieldOfView = kTurn;  ///< whole angle [rad]; 2 pi: all around
  double minRange = 0.0;       ///< along the floor [m]
  double maxRange = 20.0;      ///< [m]
  RobotNumber robot = 0;       ///< whose body it sees through: its own
};

/// Where something is in a sensor's frame.
struct Sighting {
  double range = 0.0;    ///< along the floor [m]
  double bearing = 0.0;  ///< [rad], in (-pi, pi]
};

/// Range and bearing of a point on the floor plan, or nothing if it is out of the field of view or
/// out of range. Says nothing about what is in between.
ORTUNG_API std::optional<Sighting> lookAt(const Eye& eye, double x, double y);

/// Whether nothing but what lies within @p slack metres of the point is between it and the eye.
ORTUNG_API bool isVisible(const World& world, const Eye& eye, double x, double y, double z,
                          double slack);

/// How much of a body is visible, as a share of its width as seen from the eye, in [0, 1]: sight
/// lines go to its near side, at half its height. Field of view and range are not asked.
ORTUNG_API double visibleShare(const World& world, const Eye& eye, const WorldObject& object);

}  // namespace ortung

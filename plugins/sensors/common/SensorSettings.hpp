#pragma once

/// The common part of the [[sensor]] tables of all shipped plugins.

#include <cmath>
#include <string>

#include "ortung/base/Angles.hpp"
#include "ortung/base/Parameters.hpp"
#include "ortung/base/Pose2.hpp"
#include "ortung/core/SensorContainer.hpp"
#include "ortung/robot/RobotFile.hpp"
#include "ortung/tables/RangeScale.hpp"

namespace ortung {

/// The mounting of a sensor on its robot.
struct Mounting {
  Pose2 pose;      ///< pose in the robot frame
  double z = 0.0;  ///< height above the floor [m]
};

/// Reads pose = { x_m, y_m, z_m, theta_deg }; missing values are 0, the height @p z.
inline Mounting readMounting(const Parameters& sensor, double z) {
  const Parameters pose = sensor.table("pose");
  Mounting mounting;
  mounting.pose.x = pose.numberOr("x_m", 0.0, {-10.0, 10.0});
  mounting.pose.y = pose.numberOr("y_m", 0.0, {-10.0, 10.0});
  mounting.pose.theta = wrapAngle(radians(pose.numberOr("theta_deg", 0.0, {-360.0, 360.0})));
  mounting.z = pose.numberOr("z_m", z, {0.0, 10.0});
  return mounting;
}

/// Reads period_s, the time between two readings [s]; 0: every cycle.
inline double readPeriod(const Parameters& sensor, double fallback) {
  return sensor.numberOr("period_s", fallback, {0.0, 3600.0});
}

/// Reads resolution_m and resolution_per_m, of a table of ranges.
inline RangeResolution readResolution(const Parameters& sensor, const RangeResolution& fallback) {
  return {.metres = sensor.numberOr("resolution_m", fallback.metres, {1e-3, 10.0}),
          .perMetre = sensor.numberOr("resolution_per_m", fallback.perMetre, {0.0, 1.0})};
}

/// Refuses a text other than "model/type/feature" (each part may be "*").
inline void checkQuery(const Parameters& sensor, const std::string& key) {
  try {
    parseSensorQuery(sensor.text(key));
  } catch (const std::invalid_argument& error) {
    sensor.fail(key, error.what());
  }
}

/// Reads a share, in [0, 1].
inline double readShare(const Parameters& sensor, const std::string& key) {
  return sensor.numberOr(key, 0.0, {0.0, 1.0});
}

}  // namespace ortung

#pragma once

#include "../common/SensorSettings.hpp"

namespace ortung {

/// Settings of both halves of the odometry. Its noise is set in [drive], which generates it.
struct OdometrySettings {
  SensorId id;
  double period = 0.0;  ///< time between two readings [s]
};

/// Reads all settings of both halves. @throws ConfigError
inline OdometrySettings readOdometrySettings(const Parameters& p) {
  return {sensorIdOf(p, {"odometry", "odometry", "pose"}), readPeriod(p, 0.05)};
}

}  // namespace ortung

#pragma once

#include "../common/SensorSettings.hpp"
#include "ortung/tables/SensorModel.hpp"

namespace ortung {

/// Settings of both halves of the compass.
struct CompassSettings {
  SensorId id;
  Mounting mounting;
  SensorModel model;
  double north = 0.0;       ///< direction of the needle in the field frame [rad]
  double period = 0.1;      ///< time between two readings [s]
  double noiseSigma = 0.0;  ///< standard deviation of simulated bearings [rad]
};

/// Reads all settings of both halves. @throws ConfigError
inline CompassSettings readCompassSettings(const Parameters& p) {
  CompassSettings s;
  s.id = sensorIdOf(p, {"compass", "compass", "north"});
  s.mounting = readMounting(p, 0.5);
  s.model = SensorModel::read(p, "sigma_deg", {.sigma = radians(10.0), .outliers = 0.1});
  s.north = radians(p.numberOr("north_deg", 0.0, {-360.0, 360.0}));
  s.period = readPeriod(p, 0.1);
  s.noiseSigma =
      p.has("noise_sigma_deg") ? radians(p.number("noise_sigma_deg", {0.0, 180.0})) : s.model.sigma;
  return s;
}

}  // namespace ortung

#pragma once

#include <cmath>
#include <vector>

#include "../common/SensorSettings.hpp"
#include "ortung/container/Formats.hpp"

namespace ortung {

/// Settings of both halves of a ring of ultrasonic sensors.
struct SonarSettings {
  SensorId id;                ///< its feature is the beginning of the features' names
  double z = 0.0;             ///< above the floor [m]
  std::vector<Pose2> mounts;  ///< of each sonar in the robot frame
  ConeData::Config cone;
  double minRange = 0.0;    ///< nearer echoes come back as this [m]
  double period = 0.1;      ///< [s]
  double noiseSigma = 0.0;  ///< of simulated ranges at range 0 [m]
  double noiseSigmaPerMetre = 0.0;
  double missedShare = 0.0;  ///< of echoes that do not come back
  double falseShare = 0.0;   ///< of readings that are too short, anywhere before the echo
};

/// Reads all settings of both halves. @throws ConfigError
inline SonarSettings readSonarSettings(const Parameters& p) {
  SonarSettings s;
  s.id = sensorIdOf(p, {"sonar", "ultrasonic", "sonar"});
  const Mounting ring = readMounting(p, 0.25);
  s.z = ring.z;
  const double radius = p.numberOr("ring_radius_m", 0.2, {0.0, 10.0});
  const std::vector<double> angles = p.numbersOr("angles_deg", {0.0}, -1, {-360.0, 360.0});
  if (angles.empty() || angles.size() > 64)
    p.fail("angles_deg", "has " + std::to_string(angles.size()) + " numbers, must have 1 to 64");
  for (const double degrees : angles) {
    const double angle = radians(degrees);
    s.mounts.push_back(ring.pose *
                       Pose2{radius * std::cos(angle), radius * std::sin(angle), angle});
  }
  s.cone.openingAngle = radians(p.numberOr("opening_deg", 20.0, {0.1, 120.0}));
  s.cone.maxRange = p.numberOr("max_range_m", 3.0, {0.05, 100.0});
  s.minRange = p.numberOr("min_range_m", 0.0, {0.0, s.cone.maxRange});
  s.cone.model = SensorModel::read(p, "sigma_m", s.cone.model);
  s.period = readPeriod(p, 0.1);
  s.noiseSigma = p.numberOr("noise_sigma_m", s.cone.model.sigma, {0.0, 10.0});
  s.noiseSigmaPerMetre = p.numberOr("noise_sigma_per_m", s.cone.model.sigmaPerMetre, {0.0, 1.0});
  s.missedShare = readShare(p, "missed_share");
  s.falseShare = readShare(p, "false_share");
  return s;
}

}  // namespace ortung

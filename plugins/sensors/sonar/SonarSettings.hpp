#pragma once

#include <cmath>
#include <vector>

#include "../common/SensorSettings.hpp"
#include "ortung/formats/ConeData.hpp"
#include "ortung/tables/SensorModel.hpp"

namespace ortung {

/// Settings of both halves of a ring of ultrasonic sensors.
struct SonarSettings {
  SensorId id;                ///< identifier; its feature is the prefix of the features' names
  double z = 0.0;             ///< height above the floor [m]
  std::vector<Pose2> mounts;  ///< pose of each sonar in the robot frame
  ConeData::Config cone;
  double minRange = 0.0;                 ///< least range; nearer echoes are reported as this [m]
  double period = 0.1;                   ///< time in which all sonars fire once [s]
  std::vector<std::size_t> firingOrder;  ///< indices of mounts, each once
  std::size_t atOnce = 1;                ///< number of sonars that fire together
  double noiseSigma = 0.0;               ///< standard deviation of simulated ranges at range 0 [m]
  double noiseSigmaPerMetre = 0.0;
  double missedShare = 0.0;  ///< share of echoes that are missed
  double falseShare = 0.0;   ///< share of readings that are too short, anywhere before the echo
};

/// Reads firing_order and fire_at_once; without them all fire together.
inline void readFiring(const Parameters& p, SonarSettings& s) {
  const std::size_t count = s.mounts.size();
  const auto whole = static_cast<std::int64_t>(count);
  s.atOnce = static_cast<std::size_t>(p.integerOr("fire_at_once", whole, {1, 64}));
  if (count % s.atOnce != 0)
    p.fail("fire_at_once", "is " + std::to_string(s.atOnce) +
                               ", must divide the number of sonars, " + std::to_string(count));
  std::vector<double> inTurn(count);
  for (std::size_t i = 0; i < count; ++i) inTurn[i] = static_cast<double>(i);
  std::vector<bool> fires(count, false);
  for (const double number :
       p.numbersOr("firing_order", inTurn, static_cast<int>(count), {0.0, 63.0})) {
    const auto index = static_cast<std::size_t>(number);
    if (static_cast<double>(index) != number || index >= count || fires[index])
      p.fail("firing_order", "has " + std::to_string(number) + ", must have each of 0 to " +
                                 std::to_string(count - 1) + " once");
    fires[index] = true;
    s.firingOrder.push_back(index);
  }
}

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
  readFiring(p, s);
  s.cone.openingAngle = radians(p.numberOr("opening_deg", 20.0, {0.1, 120.0}));
  s.cone.maxRange = p.numberOr("max_range_m", 3.0, {0.05, 100.0});
  s.minRange = p.numberOr("min_range_m", 0.0, {0.0, s.cone.maxRange});
  s.cone.model = SensorModel::read(p, "sigma_m", s.cone.model);
  s.cone.resolution = readResolution(p, s.cone.resolution);
  s.period = readPeriod(p, 0.1);
  s.noiseSigma = p.numberOr("noise_sigma_m", s.cone.model.sigma, {0.0, 10.0});
  s.noiseSigmaPerMetre = p.numberOr("noise_sigma_per_m", s.cone.model.sigmaPerMetre, {0.0, 1.0});
  s.missedShare = readShare(p, "missed_share");
  s.falseShare = readShare(p, "false_share");
  return s;
}

}  // namespace ortung

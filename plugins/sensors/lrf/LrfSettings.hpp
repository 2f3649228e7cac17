#pragma once

#include "../common/SensorSettings.hpp"
#include "ortung/formats/ScanData.hpp"
#include "ortung/tables/SensorModel.hpp"

namespace ortung {

/// Settings of both halves of the laser range finder.
struct LrfSettings {
  SensorId id;
  Mounting mounting;
  ScanData::Config scan;
  double period = 0.1;              ///< time between two scans [s]
  double noiseSigma = 0.0;          ///< standard deviation of simulated ranges at range 0 [m]
  double noiseSigmaPerMetre = 0.0;  ///< growth of the standard deviation with range [m/m]
  double dropoutShare = 0.0;        ///< share of simulated beams without a valid measurement
};

/// Reads fov_deg, or first_angle_deg and angle_step_deg, into the beams of @p scan.
inline void readBeams(const Parameters& p, ScanData::Config& scan) {
  scan.beams = static_cast<int>(p.integerOr("beams", 180, {1, 8192}));
  if (p.has("angle_step_deg")) {
    if (p.has("fov_deg"))
      p.fail("fov_deg", "is given beside angle_step_deg; expected one of the two");
    const double step = p.number("angle_step_deg", {0.001, 360.0});
    if (step * scan.beams > 360.0 + 1e-9)
      p.fail("angle_step_deg", "is " + std::to_string(step) + ", must be at most " +
                                   std::to_string(360.0 / scan.beams) + " with " +
                                   std::to_string(scan.beams) + " beams");
    scan.angleStep = radians(step);
    scan.firstAngle =
        radians(p.numberOr("first_angle_deg", -step * (scan.beams - 1) / 2.0, {-360.0, 360.0}));
    return;
  }
  const double fov = p.numberOr("fov_deg", 180.0, {0.1, 360.0});
  // If the scan goes all around, the last beam must not repeat the first one.
  const int steps = fov >= 360.0 ? scan.beams : scan.beams - 1;
  const double step = steps > 0 ? fov / steps : 1.0;
  if (step * scan.beams > 360.0 + 1e-9)
    p.fail("fov_deg", "is " + std::to_string(fov) + ", must be 360 or at most " +
                          std::to_string(360.0 * steps / scan.beams) + " with " +
                          std::to_string(scan.beams) + " beams");
  const double first = scan.beams == 1 ? 0.0 : -fov / 2.0;
  scan.angleStep = radians(step);
  scan.firstAngle = radians(p.numberOr("first_angle_deg", first, {-360.0, 360.0}));
}

/// Reads all settings of both halves. @throws ConfigError
inline LrfSettings readLrfSettings(const Parameters& p) {
  LrfSettings settings;
  settings.id = sensorIdOf(p, {"LMS200", "LRF", "180DegreeScan"});
  settings.mounting = readMounting(p, 0.3);
  ScanData::Config& scan = settings.scan;
  readBeams(p, scan);
  scan.maxRange = p.numberOr("max_range_m", 8.0, {0.05, 1000.0});
  scan.minRange = p.numberOr("min_range_m", 0.0, {0.0, scan.maxRange});
  if (p.choiceOr("perception", "rays", {"rays", "endpoints"}) == "endpoints") {
    scan.perception = ScanData::Perception::kEndPoints;
    scan.model.exponent = ScanData::kEndPointExponent;
  }
  scan.model = SensorModel::read(p, "sigma_m", scan.model);
  scan.resolution = readResolution(p, scan.resolution);
  scan.localizes = p.flagOr("localizes", true);
  scan.usedBeams = static_cast<int>(p.integerOr("used_beams", 0, {0, 8192}));
  scan.endPointCell = p.numberOr("endpoint_cell_m", scan.endPointCell, {0.005, 1.0});
  settings.period = readPeriod(p, 0.1);
  settings.noiseSigma = p.numberOr("noise_sigma_m", scan.model.sigma, {0.0, 10.0});
  settings.noiseSigmaPerMetre =
      p.numberOr("noise_sigma_per_m", scan.model.sigmaPerMetre, {0.0, 1.0});
  settings.dropoutShare = readShare(p, "dropout_share");
  return settings;
}

}  // namespace ortung

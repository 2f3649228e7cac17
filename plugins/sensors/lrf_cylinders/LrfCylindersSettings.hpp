#pragma once

#include <string>
#include <vector>

#include "../common/SensorSettings.hpp"
#include "../landmarks/LandmarksSettings.hpp"
#include "CylinderFinder.hpp"
#include "ortung/formats/LandmarksData.hpp"

namespace ortung {

/// Settings of all halves of the finder of cylinders in scans.
struct LrfCylindersSettings {
  std::string reads;  ///< the scan of another device that is read: "model/type/feature"
  SensorId id;
  Mounting mounting;  ///< mounting of the scanner
  std::string kind;   ///< kind of the landmarks in the world that are cylinders
  CylinderLooks looks;
  LandmarksData::Config landmarks;
};

/// Reads all settings of all halves. @throws ConfigError
inline LrfCylindersSettings readLrfCylindersSettings(const Parameters& p) {
  LrfCylindersSettings s;
  s.id = sensorIdOf(p, {"LMS200", "LRF", "cylinders"});
  s.mounting = readMounting(p, 0.3);
  s.reads = p.text("reads");
  checkQuery(p, "reads");
  s.kind = p.textOr("kind", "cylinder");
  checkKind(p, s.kind);
  s.looks.radius = p.number("radius_m", {0.005, 5.0});
  s.looks.breakDistance = p.numberOr("break_m", 0.1, {0.01, 10.0});
  s.looks.tolerance = p.numberOr("tolerance_m", 0.5 * s.looks.radius, {1e-4, 1.0});
  s.looks.leastBeams = static_cast<int>(p.integerOr("least_beams", 3, {3, 8192}));
  s.landmarks.identified = false;
  s.landmarks.identities = readIdentities(p);
  s.landmarks.maxRange = p.numberOr("max_range_m", 8.0, {0.05, 1000.0});
  s.landmarks.range = SensorModel::read(p, "range_sigma_m", {.sigma = 0.03});
  s.landmarks.bearing = SensorModel::read(p, "bearing_sigma_deg", {.sigma = radians(0.5)});
  s.landmarks.bias = readSightingBias(p, true);
  return s;
}

}  // namespace ortung

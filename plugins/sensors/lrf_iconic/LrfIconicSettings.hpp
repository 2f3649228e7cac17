#pragma once

#include "../common/SensorSettings.hpp"
#include "../lrf/LrfSettings.hpp"
#include "ScanShapes.hpp"
#include "ortung/formats/ObstaclesData.hpp"
#include "ortung/formats/PoseFixData.hpp"
#include "ortung/formats/ScanData.hpp"

namespace ortung {

/// Settings of all halves of the laser range finder that detects objects.
struct LrfIconicSettings {
  static constexpr const char* kScan = "scan";  ///< feature name of its own scan

  /// The scan of another device that is read: "model/type/feature"; "": its own.
  std::string reads;
  SensorId id;  ///< its feature is not used
  Mounting mounting;
  ScanData::Config scan;  ///< format of its own scan
  ScanShapesConfig shapes;
  PoseFixData::Config fix;
  double shareMatched = 0.6;  ///< share of beams that must end at walls, if five of them agree
  int mostFixes = 8;
  double rangeSigma = 0.03;  ///< standard deviation at range 0 that the matcher assumes [m]
  double rangeSigmaPerMetre = 0.0;
  double wallSigma = 0.005;  ///< standard deviation of a wall's place as a whole [m]
  double period = 0.1;       ///< time between two scans [s]
  double noiseSigma = 0.03;  ///< standard deviation of simulated ranges at range 0 [m]
  double noiseSigmaPerMetre = 0.0;
  double dropoutShare = 0.0;
};

/// Reads the keys of its own scan and its simulation.
inline void readOwnScan(const Parameters& p, LrfIconicSettings& s) {
  readBeams(p, s.scan);
  s.scan.maxRange = p.numberOr("max_range_m", 8.0, {0.05, 1000.0});
  s.scan.minRange = p.numberOr("min_range_m", 0.0, {0.0, s.scan.maxRange});
  s.scan.localizes = false;  // the features derived from it do
  s.period = readPeriod(p, 0.1);
  s.noiseSigma = p.numberOr("noise_sigma_m", s.noiseSigma, {0.0, 10.0});
  s.noiseSigmaPerMetre = p.numberOr("noise_sigma_per_m", 0.0, {0.0, 1.0});
  s.dropoutShare = readShare(p, "dropout_share");
}

/// Reads all settings of all halves. @throws ConfigError
inline LrfIconicSettings readLrfIconicSettings(const Parameters& p) {
  LrfIconicSettings s;
  if (p.has("feature")) p.fail("feature", "is given, but the features are obstacles and position");
  s.id = sensorIdOf(p, {"LMS200", "LRF", "iconic"});
  s.mounting = readMounting(p, 0.3);
  s.reads = p.textOr("reads", "");
  if (s.reads.empty())
    readOwnScan(p, s);
  else
    checkQuery(p, "reads");
  s.rangeSigma = p.numberOr("range_sigma_m", s.noiseSigma, {0.0, 10.0});
  s.rangeSigmaPerMetre = p.numberOr("range_sigma_per_m", s.noiseSigmaPerMetre, {0.0, 1.0});
  // For a log or a real scanner the walls are those of a measured map.
  s.wallSigma = p.numberOr("wall_sigma_m", s.reads.empty() ? 0.005 : 0.03, {0.0, 1.0});
  s.shapes.breakDistance = p.numberOr("break_m", s.shapes.breakDistance, {0.01, 10.0});
  s.shapes.lineTolerance = p.numberOr("line_tolerance_m", s.shapes.lineTolerance, {0.001, 1.0});
  s.shapes.shortest = p.numberOr("shortest_line_m", s.shapes.shortest, {0.05, 10.0});
  s.shapes.largestRound = p.numberOr("largest_round_m", s.shapes.largestRound, {0.02, 10.0});
  s.shareMatched = p.numberOr("share_matched", s.shareMatched, {0.0, 1.0});
  s.mostFixes = static_cast<int>(p.integerOr("most_positions", 8, {1, 64}));
  s.fix.addedSigma = p.numberOr("sigma_m", s.fix.addedSigma, {1e-4, 100.0});
  s.fix.addedHeadingSigma = radians(p.numberOr("sigma_deg", 2.0, {1e-3, 180.0}));
  s.fix.model.outliers = p.numberOr("outliers", 0.05, {1e-6, 1.0 - 1e-6});
  s.fix.model.exponent = p.numberOr("exponent", 1.0, {1e-3, 1.0});
  return s;
}

}  // namespace ortung

#pragma once

#include "../common/SensorSettings.hpp"
#include "ortung/formats/PoseFixData.hpp"

namespace ortung {

/// Settings of the features from a team's messages.
struct TeammateSettings {
  /// Feature into which received messages are written.
  static constexpr const char* kTalk = "talk";

  SensorId id;  ///< its feature is not used
  PoseFixData::Config fix;
  double keep = 2.0;  ///< time for which a message is remembered [s]
};

/// Reads all settings of both halves. @throws ConfigError
inline TeammateSettings readTeammateSettings(const Parameters& p) {
  TeammateSettings s;
  if (p.has("feature"))
    p.fail("feature", "is given, but the features are position, robots, balls and talk");
  s.id = sensorIdOf(p, {"radio", "teammate", "talk"});
  s.fix.addedSigma = p.numberOr("sigma_m", s.fix.addedSigma, {1e-4, 100.0});
  s.fix.addedHeadingSigma = radians(p.numberOr("sigma_deg", 2.0, {1e-3, 180.0}));
  s.fix.model.outliers = p.numberOr("outliers", 0.05, {1e-6, 1.0 - 1e-6});
  s.fix.model.exponent = p.numberOr("exponent", 1.0, {1e-3, 1.0});
  s.keep = p.numberOr("keep_s", s.keep, {0.0, 3600.0});
  return s;
}

}  // namespace ortung

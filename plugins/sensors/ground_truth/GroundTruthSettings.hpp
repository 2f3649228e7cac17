#pragma once

#include "../common/SensorSettings.hpp"

namespace ortung {

/// Settings of both halves of the ground truth, which has no noise.
struct GroundTruthSettings {
  SensorId id;
  double period = 0.0;  ///< time between two readings [s]
};

/// Reads all settings of both halves. @throws ConfigError
inline GroundTruthSettings readGroundTruthSettings(const Parameters& p) {
  return {sensorIdOf(p, {"reference", "groundTruth", "pose"}), readPeriod(p, 0.05)};
}

}  // namespace ortung

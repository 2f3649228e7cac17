#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "ortung/base/Export.hpp"
#include "ortung/base/Pose2.hpp"
#include "ortung/core/SensorData.hpp"

namespace ortung {

/// One value of a reading beside what the feature expects of it at a pose.
struct ReadingValue {
  bool isAngle = false;            ///< [rad]; otherwise [m]
  std::optional<double> measured;  ///< nothing: not measured, or not comparable
  std::optional<double> expected;  ///< nothing: nothing is expected there
};

/// All values of a feature, in the order of SensorData::expectation(): beams of a scan, range and
/// bearing of each landmark of a list, one of all else. Of points only expectations are there: how
/// far each is from the nearest learned one. What is beyond the sensor's range is infinite.
/// None of a feature that has not learned. Under the container's read lock if others set readings.
ORTUNG_API std::vector<ReadingValue> readingValues(const SensorData& feature, const Pose2& pose);

}  // namespace ortung

#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "ortung/base/Export.hpp"
#include "ortung/base/Pose2.hpp"
#include "ortung/core/SensorData.hpp"

namespace ortung {

/// One value of a reading with its expectation at a pose.
struct ReadingValue {
  bool isAngle = false;            ///< whether it is an angle [rad]; else it is a length [m]
  std::optional<double> measured;  ///< measured value; nothing: not measured, or not comparable
  std::optional<double> expected;  ///< expected value; nothing: no expectation there
};

/// Returns all values of a feature, in the order of SensorData::expectation(): beams of a scan,
/// range and bearing of each landmark of a list, one value of other features. Points have
/// expectations only: the distance of each from the nearest learned one. Values beyond the sensor's
/// range are infinite. A feature that has not learned has no values. The caller holds the
/// container's read lock if other threads set readings.
ORTUNG_API std::vector<ReadingValue> readingValues(const SensorData& feature, const Pose2& pose);

}  // namespace ortung

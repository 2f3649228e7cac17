#include "ortung/run/ReadingValues.hpp"

#include <algorithm>
#include <cmath>

#include "ortung/formats/BearingData.hpp"
#include "ortung/formats/ConeData.hpp"
#include "ortung/formats/LandmarksData.hpp"
#include "ortung/formats/ScalarData.hpp"
#include "ortung/formats/ScanData.hpp"

namespace ortung {
namespace {

std::optional<double> unlessNaN(double value) {
  return std::isnan(value) ? std::nullopt : std::optional(value);
}

/// A reading's own beams may be others than those that are expected: the nearest one counts.
void addBeams(const ScanData& scan, std::vector<ReadingValue>& values) {
  const ScanData::Reading& reading = scan.reading();
  if (scan.sequence() == 0 || reading.ranges.empty()) return;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double angle =
        scan.config().firstAngle + static_cast<double>(i) * scan.config().angleStep;
    const double beam =
        reading.angleStep == 0.0 ? 0.0 : (angle - reading.firstAngle) / reading.angleStep;
    const double nearest = std::nearbyint(beam);
    if (nearest >= 0.0 && nearest < static_cast<double>(reading.ranges.size()))
      values[i].measured =
          unlessNaN(static_cast<double>(reading.ranges[static_cast<std::size_t>(nearest)]));
  }
}

void addSightings(const LandmarksData& landmarks, const Pose2& pose,
                  std::vector<ReadingValue>& values) {
  for (const LandmarksData::Sighting& sighting : landmarks.reading()) {
    const std::ptrdiff_t found = landmarks.indexOf(sighting, pose);
    const auto index = 2 * static_cast<std::size_t>(std::max<std::ptrdiff_t>(0, found));
    if (found < 0 || index + 1 >= values.size()) continue;
    const LandmarksData::Sighting corrected = landmarks.corrected(sighting);
    values[index].measured = corrected.range;
    values[index + 1].measured = corrected.bearing;
  }
}

}  // namespace

bool isAngle(const SensorData& feature, std::size_t index) {
  if (dynamic_cast<const LandmarksData*>(&feature) != nullptr) return index % 2 == 1;
  return dynamic_cast<const BearingData*>(&feature) != nullptr;
}

std::vector<ReadingValue> readingValues(const SensorData& feature, const Pose2& pose) {
  std::vector<ReadingValue> values;
  if (!feature.isLearned()) return values;
  for (const double expected : feature.expectation(pose))
    values.push_back({isAngle(feature, values.size()), std::nullopt, unlessNaN(expected)});
  if (const auto* scan = dynamic_cast<const ScanData*>(&feature)) addBeams(*scan, values);
  if (const auto* all = dynamic_cast<const LandmarksData*>(&feature))
    addSightings(*all, pose, values);
  if (values.size() != 1 || feature.sequence() == 0) return values;
  if (const auto* scalar = dynamic_cast<const ScalarData*>(&feature))
    values.front().measured = scalar->reading();
  if (const auto* bearing = dynamic_cast<const BearingData*>(&feature))
    values.front().measured = bearing->reading();
  if (const auto* cone = dynamic_cast<const ConeData*>(&feature))
    values.front().measured = unlessNaN(cone->reading());
  return values;
}

}  // namespace ortung

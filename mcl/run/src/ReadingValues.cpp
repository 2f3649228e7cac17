#include "ortung/run/ReadingValues.hpp"

#include <algorithm>
#include <cmath>

namespace ortung {
namespace {

std::optional<double> unlessNaN(double value) {
  return std::isnan(value) ? std::nullopt : std::optional(value);
}

}  // namespace

std::vector<ReadingValue> readingValues(const SensorData& feature, const Pose2& pose) {
  std::vector<ReadingValue> values;
  if (!feature.isLearned()) return values;
  for (const double expected : feature.expectation(pose))
    values.push_back({feature.isAngle(values.size()), std::nullopt, unlessNaN(expected)});
  if (values.empty() || feature.sequence() == 0) return values;
  const std::vector<double> measured = feature.measured(pose);
  for (std::size_t i = 0; i < std::min(values.size(), measured.size()); ++i)
    values[i].measured = unlessNaN(measured[i]);
  return values;
}

}  // namespace ortung

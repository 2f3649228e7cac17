#pragma once

#include <string>
#include <vector>

#include "ortung/base/Export.hpp"
#include "ortung/base/Pose2.hpp"
#include "ortung/run/ReadingValues.hpp"
#include "ortung/run/Robot.hpp"

namespace ortung {

/// How probable a robot's present readings are at one pose, and why.
struct Why {
  /// What one feature says there.
  struct Feature {
    SensorId id;
    double p = 0.0;  ///< probability of its reading; kNoExpectation: it has none, or expects none
    std::vector<ReadingValue> values;  ///< values as of readingValues(), at most 2048
  };
  double p = 0.0;  ///< probability of all readings together; kNoExpectation: no feature has any
  std::vector<Feature> features;
};

/// By the same rule as SensorContainer::getProbability().
/// @param queries as of HeatMapWish @throws ServeError as chosenFeatures()
ORTUNG_API Why whyAt(const Robot& robot, const std::vector<std::string>& queries,
                     const Pose2& pose);

}  // namespace ortung

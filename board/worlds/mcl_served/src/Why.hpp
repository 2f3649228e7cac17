#pragma once

#include <string>
#include <vector>

#include "ortung/base/Pose2.hpp"
#include "ortung/run/Robot.hpp"

namespace ortung {

/// How probable a robot's present readings are at one pose, and why.
struct Why {
  double p = 0.0;  ///< probability of all readings together; kNoExpectation: no feature has any
  std::vector<std::string> lines;  ///< lines of the reply, see WHY in docs/protocol.md
};

/// By the same rule as SensorContainer::getProbability().
/// @param queries as of HeatMapWish @throws ServeError as chosenFeatures()
Why whyAt(const Robot& robot, const std::vector<std::string>& queries, const Pose2& pose);

}  // namespace ortung

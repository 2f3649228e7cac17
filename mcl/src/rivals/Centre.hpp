#pragma once

#include "ortung/base/Pose2.hpp"
#include "ortung/mcl/SampleSet.hpp"

namespace ortung {

/// Mean of samples, and their standard deviation in metres and radians together.
struct Centre {
  Pose2 pose;
  double open = 0.0;
};
Centre centreOf(const SampleSet& set);

/// Returns the distance of two poses [m] plus the turn between them [rad].
double apart(const Pose2& a, const Pose2& b);

/// Returns whether a hypothesis is at the same place as the belief, so that it is no alternative.
bool isSame(const Pose2& rival, const Pose2& belief);

}  // namespace ortung

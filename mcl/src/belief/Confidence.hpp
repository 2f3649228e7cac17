#pragma once

#include <optional>

#include "ortung/base/Export.hpp"
#include "ortung/base/PoseCovariance.hpp"
#include "ortung/mcl/PoseEstimate.hpp"

namespace ortung {

/// What tells how far an estimate can be trusted.
struct Signs {
  double fit = 1.0;        ///< newest readings where they fit best, as a share of what is usual
  double fitLately = 1.0;  ///< the same, averaged over some readings
  int unusual = 0;         ///< readings on end that did not fit as they use to
  double lead = 0.0;       ///< of a rival over the belief [nats]
  bool isFrozen = false;   ///< a device repeats its reading though the robot moves
  bool trustsOdometry = true;
  bool isConfirmed = true;  ///< where a global start has found the robot, by readings since
  /// Time since the last reading that was weighed, in what is usual between two; none: no reading.
  std::optional<double> silence = 0.0;
  bool isLate = false;  ///< readings, by their stamps
};

/// Probability that a position is within @p metres of the mean of a Gaussian with this covariance.
ORTUNG_API double probabilityWithin(const PoseCovariance& covariance, double metres);

/// Fills in quality, status and reason of an estimate whose share and covariance are known.
ORTUNG_API void judge(const Signs& signs, PoseEstimate& estimate);

}  // namespace ortung

#pragma once

#include <optional>

#include "ortung/base/Export.hpp"
#include "ortung/base/PoseCovariance.hpp"
#include "ortung/mcl/PoseEstimate.hpp"

namespace ortung {

/// What tells how far an estimate can be trusted.
struct Signs {
  double fit = 1.0;        ///< best fit of the newest readings, as a share of the usual one
  double fitLately = 1.0;  ///< short-term average of the fit
  int unusual = 0;         ///< number of readings in a row that fitted worse than usual
  double lead = 0.0;       ///< lead of an alternative place over the belief [nats]
  bool isFrozen = false;   ///< whether a device repeats its reading though the robot moves
  bool trustsOdometry = true;
  /// Whether readings since have confirmed the place that a global start has found.
  bool isConfirmed = true;
  /// Time since the last reading that was weighed, in usual intervals; none: no reading.
  std::optional<double> silence = 0.0;
  bool isLate = false;  ///< whether stamps of readings are late
};

/// Probability that a position is within @p metres of the mean of a Gaussian with this covariance.
ORTUNG_API double probabilityWithin(const PoseCovariance& covariance, double metres);

/// Fills in quality, status and reason of an estimate whose share and covariance are known.
ORTUNG_API void judge(const Signs& signs, PoseEstimate& estimate);

}  // namespace ortung

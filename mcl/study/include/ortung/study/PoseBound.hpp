#pragma once

#include <array>
#include <limits>
#include <span>
#include <vector>

#include "ortung/base/Export.hpp"
#include "ortung/base/Pose2.hpp"
#include "ortung/base/PoseCovariance.hpp"
#include "ortung/base/Time.hpp"

namespace ortung {

/// One moment of a run whose truth is exact.
struct BoundStep {
  Timestamp stamp = 0;
  Pose2 truth;     ///< field frame
  Pose2 odometry;  ///< odometry frame
  /// Fisher information of the moment's readings about x, y [1/m^2] and theta, field frame,
  /// row-major; nothing: zeros.
  std::array<double, 9> information{};
};

/// How good estimates can be at all.
struct PoseBound {
  Timestamp stamp = 0;
  PoseCovariance covariance{};  ///< least one of an unbiased estimate, as of PoseEstimate
};

/// Figures of a bound, as of EvaluationErrors.
struct BoundFigures {
  double positionMedian = std::numeric_limits<double>::quiet_NaN();  ///< [m]
  double positionRmse = std::numeric_limits<double>::quiet_NaN();    ///< [m]
  double headingRmse = std::numeric_limits<double>::quiet_NaN();     ///< [rad]
};

/// The posterior Cramer-Rao bound (Tichavsky, Muravchik, Nehorai 1998) of a filter's estimates:
/// J' = (F J^-1 F^T + Q)^-1 + I. The noise Q of odometry is what it was in the run: variances that
/// grow with way and turn, fitted to odometry beside truth.
/// @param steps in the order of time @param sigmaStart of the first place [m], [rad]
ORTUNG_API std::vector<PoseBound> poseBound(std::span<const BoundStep> steps,
                                            double sigmaStart = 1.0);

/// Errors that estimates with these covariances have, of normal distributions.
/// @param since steps before do not count
ORTUNG_API BoundFigures figuresOf(std::span<const PoseBound> bounds, Timestamp since);

}  // namespace ortung

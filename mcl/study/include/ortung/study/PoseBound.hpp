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

/// One time step of a run whose truth is exact.
struct BoundStep {
  Timestamp stamp = 0;  ///< time of the readings [us]
  Pose2 truth;          ///< true pose, field frame
  Pose2 odometry;       ///< odometry's pose, odometry frame
  /// Fisher information of the readings about x, y [1/m^2] and theta, field frame,
  /// row-major; nothing: zeros.
  std::array<double, 9> information{};
};

/// The least covariance that estimates can have at a time.
struct PoseBound {
  Timestamp stamp = 0;          ///< time of the estimate [us]
  PoseCovariance covariance{};  ///< least covariance of an unbiased estimate, field frame
};

/// Figures of a bound, to be compared with those of EvaluationErrors.
struct BoundFigures {
  double positionMedian = std::numeric_limits<double>::quiet_NaN();  ///< median error [m]
  double positionRmse = std::numeric_limits<double>::quiet_NaN();    ///< [m]
  double headingRmse = std::numeric_limits<double>::quiet_NaN();     ///< [rad]
};

/// The posterior Cramer-Rao bound (Tichavsky, Muravchik, Nehorai 1998) of a filter's estimates:
/// J' = (F J^-1 F^T + Q)^-1 + I. The noise Q of odometry is that of the run: variances that grow
/// with distance and turn, fitted to odometry and truth.
/// @param steps steps in the order of time
/// @param sigmaStart standard deviation of the first pose [m], [rad]
ORTUNG_API std::vector<PoseBound> poseBound(std::span<const BoundStep> steps,
                                            double sigmaStart = 1.0);

/// Returns the errors of estimates whose errors are normal with these covariances.
/// @param since earlier steps do not count
ORTUNG_API BoundFigures figuresOf(std::span<const PoseBound> bounds, Timestamp since);

}  // namespace ortung

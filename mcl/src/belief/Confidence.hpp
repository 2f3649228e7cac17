#pragma once

#include <optional>

#include "ortung/base/Export.hpp"
#include "ortung/base/PoseCovariance.hpp"
#include "ortung/mcl/PoseEstimate.hpp"

namespace ortung {

/// The probabilities with which errors are beyond the protection level.
inline constexpr double kBeyondTracking = 0.001;
inline constexpr double kBeyondUncertain = 0.01;

/// The evidence from which the confidence in an estimate is computed.
struct Signs {
  /// Short-term average of how well readings fit, as a share of the usual fit.
  double fitLately = 1.0;
  int unusual = 0;        ///< number of readings in a row that fitted worse than usual
  double lead = 0.0;      ///< lead of an alternative place over the belief [nats]
  bool isFrozen = false;  ///< whether a device repeats its reading though the robot moves
  bool trustsOdometry = true;
  /// Whether later readings have confirmed the place that a global start found; true without a
  /// global start.
  bool isConfirmed = true;
  /// Time since the last reading that was weighed, in units of the usual interval between readings;
  /// nothing: there was no reading.
  std::optional<double> silence = 0.0;
  bool isLate = false;  ///< whether stamps of readings seem delayed
  /// Whether they may be delayed: nothing says so, nor has the robot turned or changed its speed.
  bool mayBeLate = false;
  PoseDistance apart = {};  ///< how far the estimate is from where odometry has led to, unexplained
  /// How far from the estimate the belief reaches at other places; nothing: that is not known.
  std::optional<PoseDistance> others = std::nullopt;
  /// The estimate's share of the probability of places that look like its place, itself among them,
  /// and how far away those are that can't be left out.
  double shareOfAlike = 1.0;
  PoseDistance alike = {};
};

/// Returns the probability that the position of a pose drawn from a Gaussian with this covariance
/// is within @p metres of its mean.
ORTUNG_API double probabilityWithin(const PoseCovariance& covariance, double metres);

/// Fills in quality, status, reason and protection level of an estimate whose share and covariance
/// are already set; the share is at most that of places that look alike.
ORTUNG_API void judge(const Signs& signs, PoseEstimate& estimate);

}  // namespace ortung

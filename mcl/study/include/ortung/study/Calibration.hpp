#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "ortung/base/Export.hpp"
#include "ortung/study/Evaluation.hpp"

namespace ortung {

/// A probability that was claimed, and whether the event happened.
struct Claim {
  float probability = 0.0F;  ///< claimed probability, in [0, 1]
  bool cameTrue = false;     ///< whether the event happened
};

/// Claims of about the same probability.
struct ReliabilityBin {
  std::size_t count = 0;  ///< number of claims
  double claimed = 0.0;   ///< mean claimed probability; NaN without claims
  double share = 0.0;     ///< share of claims that came true; NaN without claims
};

/// How well claimed probabilities agree with what happened.
struct Calibration {
  std::array<ReliabilityBin, 10> bins;  ///< claims in [0, 0.1), ..., [0.9, 1]
  /// Mean of |claimed - share| over all claims (expected calibration error); NaN without claims.
  double error = 0.0;
  /// Area under the ROC curve: probability that a claim that came true was higher than one that did
  /// not; ties count half. NaN without claims of both kinds.
  double area = 0.0;
};

/// Computes the calibration of claims.
ORTUNG_API Calibration calibrationOf(std::vector<Claim> claims);

/// Computes the calibration of the filter's probability that the position error is below 0.5 m.
ORTUNG_API Calibration qualityCalibration(const std::vector<EvaluationPoint>& points);

}  // namespace ortung

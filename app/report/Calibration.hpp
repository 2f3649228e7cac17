#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace ortung::app {

/// A probability that was claimed, and whether it came true.
struct Claim {
  float probability = 0.0F;  ///< in [0, 1]
  bool cameTrue = false;
};

/// Claims of about the same probability.
struct ReliabilityBin {
  std::size_t count = 0;
  double claimed = 0.0;  ///< mean probability; NaN of nothing
  double share = 0.0;    ///< that came true; NaN of nothing
};

/// How well claims fit what came of them.
struct Calibration {
  std::array<ReliabilityBin, 10> bins;  ///< [0, 0.1), ..., [0.9, 1]
  /// Mean of |claimed - share| over all claims (expected calibration error); NaN of nothing.
  double error = 0.0;
  /// Probability that of a claim that came true and one that did not, the former was the higher
  /// one; ties count half (area under the ROC curve). NaN if there are none of either.
  double area = 0.0;
};

Calibration calibrationOf(std::vector<Claim> claims);

}  // namespace ortung::app

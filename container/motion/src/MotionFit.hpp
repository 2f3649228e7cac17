#pragma once

#include <array>
#include <vector>

#include "ortung/base/Export.hpp"

namespace ortung {

/// One scalar error of odometry (of a turn, or of a way) over a piece of a drive. Sums of
/// neighbouring pieces are errors of longer ones.
struct MotionError {
  double error = 0.0;                 ///< truth minus odometry
  std::array<double, 2> causes{};     ///< what a constant share of it may come from, with its sign
  std::array<double, 2> roughness{};  ///< what its variance may grow with, not negative
};

/// error = sum scale_k cause_k + noise of variance sum variance_k roughness_k + error of the truth.
struct MotionFit {
  std::array<double, 2> scale{};  ///< factor of each cause; zero where it could be random
  std::array<double, 2>
      variance{};  ///< variance per roughness; below 0: not known, as the roughness was always 0
  double truthVariance = 0.0;  ///< variance of the difference of two true values
  double outliers = 0.0;       ///< share of errors that are four times as large as others
  double logLikelihood = 0.0;  ///< mean of an error, robust
};

/// The most likely parameters. Errors are looked at over 1, 2, 4, 8 and 16 pieces in a row, each
/// length with the same say: what grows with the number of pieces is motion's, what stays is the
/// truth's own error. A share of errors, which is learned, is four times as large as the others;
/// what is farther off (truth that jumped) hardly counts.
/// @param drives pieces of each drive, in their order
/// @throws std::runtime_error if there are fewer than 30 pieces
ORTUNG_API MotionFit fitMotion(const std::vector<std::vector<MotionError>>& drives);

}  // namespace ortung

#pragma once

#include <cstdint>
#include <vector>

#include "ortung/base/Export.hpp"

namespace ortung {

/// A figure with an interval that holds the true value with a probability of 95 %.
struct Interval {
  double value = 0.0;
  double low = 0.0;
  double high = 1.0;
};

/// Returns the share of @p hits among @p n trials with its interval, which is right for shares near
/// 0 and 1, too (Wilson, "Probable inference, the law of succession, and statistical inference",
/// JASA 22, 1927). No trials give 0, from 0 to 1. @pre hits <= n
ORTUNG_API Interval wilson(std::uint64_t hits, std::uint64_t n);

/// Returns the quantile of a sample, interpolated linearly between order statistics (type 7 of
/// Hyndman and Fan, "Sample quantiles in statistical packages", American Statistician 50, 1996).
/// @param share in [0, 1]; 0.5 gives the median @returns NaN for no values
ORTUNG_API double quantile(std::vector<double> values, double share);

}  // namespace ortung

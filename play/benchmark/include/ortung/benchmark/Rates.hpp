#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "ortung/base/Export.hpp"

namespace ortung {

/// A figure with an interval that holds the true one with 95 %.
struct Interval {
  double value = 0.0;
  double low = 0.0;
  double high = 0.0;
};

/// A share of @p n trials, with the interval of Wilson (1927), which is right for shares near 0 and
/// 1, too. Of no trials: 0, from 0 to 1. @pre hits <= n
ORTUNG_API Interval wilson(std::uint64_t hits, std::uint64_t n);

/// Mean of differences between pairs, with its interval by bootstrap: @p resamples times as many
/// pairs are drawn with replacement, and the interval is between the 2.5 % and 97.5 % of the means.
/// @param differences of -1, 0 or 1 @param seed the same gives the same interval
ORTUNG_API Interval pairedBootstrap(std::span<const int> differences, std::uint64_t seed,
                                    std::size_t resamples = 1000);

/// A figure with the interval between the 2.5 % and 97.5 % of what was drawn for it; without any it
/// is the figure itself.
ORTUNG_API Interval percentiles(double value, std::vector<double> drawn);

}  // namespace ortung

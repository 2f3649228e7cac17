#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "ortung/base/Export.hpp"
#include "ortung/base/Statistics.hpp"

namespace ortung {

/// Returns the mean of differences between pairs with its 95 % interval by bootstrap: @p resamples
/// times as many pairs are drawn with replacement, and the interval is between the 2.5 % and 97.5 %
/// of the means, as percentiles() has it.
/// @param differences differences, e.g. each -1, 0 or 1 @param seed the same seed gives the same
///   interval
/// @returns 0 in [-1, 1], which says nothing, if there are no pairs or no draws
ORTUNG_API Interval pairedBootstrap(std::span<const int> differences, std::uint64_t seed,
                                    std::size_t resamples = 1000);

/// Returns a figure with the interval between the 2.5 % and 97.5 % quantiles of its resampled
/// values; if there are none, the interval is the figure itself.
ORTUNG_API Interval percentiles(double value, std::vector<double> drawn);

}  // namespace ortung

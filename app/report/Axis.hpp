#pragma once

#include <vector>

namespace ortung::app {

/// The largest of 1, 2 and 5 times a power of ten that is not above @p length; 1 for what is no
/// positive number.
double roundLength(double length);

/// Multiples of a round step between two ends, @p most of them at most; none if the ends are no
/// numbers or the wrong way round.
std::vector<double> axisTicks(double low, double high, int most);

}  // namespace ortung::app

#pragma once

#include <vector>

namespace ortung::app {

/// Returns the largest number that is 1, 2 or 5 times a power of ten and not above @p length; 1 if
/// that is not a positive number.
double roundLength(double length);

/// Returns multiples of a round step between two ends, at most @p most; none if the ends are not
/// finite or not in order.
std::vector<double> axisTicks(double low, double high, int most);

}  // namespace ortung::app

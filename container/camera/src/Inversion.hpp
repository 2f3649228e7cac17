#pragma once

#include <cmath>

namespace ortung {

/// x in [low, high] where an increasing function is @p target, by Newton's steps that a shrinking
/// bracket keeps in bounds. @param f gives the value and, by its second argument, the slope
/// @pre f(low) <= target <= f(high)
template <typename Function>
double solveIncreasing(const Function& f, double target, double low, double high) {
  double x = 0.5 * (low + high);
  for (int i = 0; i < 200; ++i) {
    double slope = 0.0;
    const double error = f(x, slope) - target;
    (error > 0.0 ? high : low) = x;
    double next = slope > 0.0 ? x - error / slope : low - 1.0;
    if (!(next > low && next < high)) next = 0.5 * (low + high);
    if (std::abs(next - x) <= 1e-16 * (1.0 + std::abs(x))) return next;
    x = next;
  }
  return x;
}

/// The first x in (0, most] where the slope is not positive any more, or @p most.
template <typename Function>
double endOfIncrease(const Function& f, double most, int steps = 4096) {
  for (int i = 1; i <= steps; ++i) {
    const double x = most * i / steps;
    double slope = 0.0;
    f(x, slope);
    if (!(slope > 1e-9)) return most * (i - 1) / steps;
  }
  return most;
}

}  // namespace ortung

#pragma once

#include <cmath>
#include <cstddef>
#include <limits>

#include "SweepTable.hpp"

namespace ortung::app {

/// Sums up one figure over tasks: mean and standard error, by Welford's method.
class SweepMean {
 public:
  /// Adds a value; one that is not finite does not count.
  void add(double value) {
    if (!std::isfinite(value)) return;
    ++count_;
    const double before = mean_;
    mean_ += (value - before) / static_cast<double>(count_);
    squares_ += (value - before) * (value - mean_);
  }
  /// An error that is nothing but rounding, since all values are the same, is 0.
  SweepTable::Cell cell() const {
    const auto n = static_cast<double>(count_);
    const double error =
        count_ > 1 ? std::sqrt(squares_ / (n - 1.0) / n) : std::numeric_limits<double>::quiet_NaN();
    // Equal figures differ from their mean by rounding alone.
    const bool isRounding = error <= kRounding * std::abs(mean_);
    return {count_, count_ > 0 ? mean_ : std::numeric_limits<double>::quiet_NaN(),
            isRounding ? 0.0 : error};
  }

 private:
  static constexpr double kRounding = 1e-12;  ///< error that is none, as a share of the mean
  std::size_t count_ = 0;
  double mean_ = 0.0;
  double squares_ = 0.0;
};

}  // namespace ortung::app

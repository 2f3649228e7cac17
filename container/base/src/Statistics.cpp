#include "ortung/base/Statistics.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace ortung {

Interval wilson(std::uint64_t hits, std::uint64_t n) {
  if (n == 0) return {};
  constexpr double kZ = 1.959963984540054;  // quantile of 95 %
  const auto count = static_cast<double>(n);
  const double p = static_cast<double>(hits) / count;
  const double scale = 1.0 + kZ * kZ / count;
  const double middle = (p + kZ * kZ / (2.0 * count)) / scale;
  const double half =
      kZ / scale * std::sqrt(p * (1.0 - p) / count + kZ * kZ / (4.0 * count * count));
  // The formula has rounding errors where the ends are exactly 0 and 1.
  return {p, hits == 0 ? 0.0 : middle - half, hits == n ? 1.0 : middle + half};
}

double quantile(std::vector<double> values, double share) {
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  std::sort(values.begin(), values.end());
  const double place = share * static_cast<double>(values.size() - 1);
  const auto below = static_cast<std::size_t>(place);
  const std::size_t above = std::min(below + 1, values.size() - 1);
  return values[below] + (place - static_cast<double>(below)) * (values[above] - values[below]);
}

}  // namespace ortung

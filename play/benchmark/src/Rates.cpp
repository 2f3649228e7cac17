#include "ortung/benchmark/Rates.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "ortung/base/Random.hpp"

namespace ortung {

Interval pairedBootstrap(std::span<const int> differences, std::uint64_t seed,
                         std::size_t resamples) {
  const std::size_t n = differences.size();
  if (n == 0 || resamples == 0) return {0.0, -1.0, 1.0};
  std::int64_t sum = 0;
  for (const int difference : differences) sum += difference;
  Random random(seed, 0);
  std::vector<double> means;
  for (std::size_t i = 0; i < resamples; ++i) {
    std::int64_t drawn = 0;
    for (std::size_t k = 0; k < n; ++k) drawn += differences[random.below(n)];
    means.push_back(static_cast<double>(drawn) / static_cast<double>(n));
  }
  return percentiles(static_cast<double>(sum) / static_cast<double>(n), std::move(means));
}

Interval percentiles(double value, std::vector<double> drawn) {
  if (drawn.empty()) return {value, value, value};
  std::sort(drawn.begin(), drawn.end());
  const auto at = [&](double share) {
    return drawn[static_cast<std::size_t>(
        std::lround(share * static_cast<double>(drawn.size() - 1)))];
  };
  return {value, at(0.025), at(0.975)};
}

}  // namespace ortung

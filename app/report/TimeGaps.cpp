#include "TimeGaps.hpp"

#include <algorithm>

namespace ortung::app {

double longestDrawnStep(std::vector<Timestamp> stamps) {
  std::vector<double> steps;
  for (std::size_t i = 1; i < stamps.size(); ++i)
    steps.push_back(toSeconds(stamps[i]) - toSeconds(stamps[i - 1]));
  if (steps.empty()) return 1.0;
  const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
  std::nth_element(steps.begin(), middle, steps.end());
  return std::max(1.0, 5.0 * *middle);
}

}  // namespace ortung::app

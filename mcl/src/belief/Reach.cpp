#include "Reach.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <utility>
#include <vector>

#include "ortung/base/Angles.hpp"

namespace ortung {
namespace {

using Weighed = std::pair<double, double>;  ///< distance, weight

constexpr std::size_t kFew = 64;

/// Returns the least distance beyond which there is at most this share of the weights. Only the
/// farthest are sorted, since few are as far as that.
double quantile(std::vector<Weighed>& all, double rest) {
  for (std::size_t few = kFew;; few *= 4) {
    const std::size_t count = std::min(few, all.size());
    const auto end = all.begin() + static_cast<std::ptrdiff_t>(count);
    std::partial_sort(all.begin(), end, all.end(), std::greater<>());
    double beyond = 0.0;
    for (auto each = all.begin(); each != end; ++each) {
      beyond += each->second;
      if (beyond > rest) return each->first;
    }
    if (count == all.size()) return 0.0;
  }
}

}  // namespace

PoseDistance reachOf(const SampleView& samples, std::span<const double> weights, const Pose2& pose,
                     double rest) {
  std::vector<Weighed> squares;
  std::vector<Weighed> radians;
  squares.reserve(weights.size());
  radians.reserve(weights.size());
  for (std::size_t i = 0; i < weights.size(); ++i) {
    if (!(weights[i] > 0.0)) continue;
    const double dx = static_cast<double>(samples.x[i]) - pose.x;
    const double dy = static_cast<double>(samples.y[i]) - pose.y;
    squares.emplace_back(dx * dx + dy * dy, weights[i]);
    radians.emplace_back(std::abs(wrapAngle(static_cast<double>(samples.theta[i]) - pose.theta)),
                         weights[i]);
  }
  return {std::sqrt(quantile(squares, rest)), quantile(radians, rest)};
}

}  // namespace ortung

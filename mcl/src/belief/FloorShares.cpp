#include "FloorShares.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace ortung {

std::vector<double> floorShares(const Building& building, const SampleSet& samples) {
  std::vector<double> shares(building.floors.size(), 0.0);
  float most = -std::numeric_limits<float>::infinity();
  for (const float weight : samples.logWeight) most = std::fmax(most, weight);
  if (!std::isfinite(most)) return shares;
  double sum = 0.0;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const double weight = std::exp(static_cast<double>(samples.logWeight[i] - most));
    if (!std::isfinite(samples.x[i]) || !std::isfinite(weight)) continue;
    shares[building.floorAt(static_cast<double>(samples.x[i]))] += weight;
    sum += weight;
  }
  if (sum > 0.0)
    for (double& share : shares) share /= sum;
  return shares;
}

std::vector<double> greaterBeside(std::size_t here, const std::vector<double>& a,
                                  const std::vector<double>& b) {
  std::vector<double> shares(a.size(), 0.0);
  double others = 0.0;
  for (std::size_t i = 0; i < shares.size(); ++i) {
    if (i == here) continue;
    shares[i] = std::max(a[i], b[i]);
    others += shares[i];
  }
  shares[here] = std::max(0.0, 1.0 - others);
  if (others > 1.0)
    for (double& share : shares) share /= others;
  return shares;
}

}  // namespace ortung

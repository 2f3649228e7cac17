#include "Statistics.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace ortung::app {
namespace {

constexpr std::size_t kMostExact = 50;  ///< differences

struct Rank {
  long doubled;  ///< twice the rank, so that the middle of ties is a whole number
  bool isPositive;
};

/// @param tieSum out: sum of t^3 - t over all ties of t
std::vector<Rank> signedRanks(const std::vector<double>& differences, double& tieSum) {
  std::vector<double> some;
  for (const double d : differences)
    if (d != 0.0 && std::isfinite(d)) some.push_back(d);
  std::ranges::sort(some, {}, [](double d) { return std::abs(d); });
  std::vector<Rank> ranks;
  tieSum = 0.0;
  for (std::size_t i = 0; i < some.size();) {
    std::size_t end = i;
    while (end < some.size() && std::abs(some[end]) == std::abs(some[i])) ++end;
    const auto ties = static_cast<double>(end - i);
    tieSum += ties * ties * ties - ties;
    const auto doubled = static_cast<long>(i + 1 + end);  // (i + 1) + ... + end in the mean, twice
    for (; i < end; ++i) ranks.push_back({doubled, some[i] > 0.0});
  }
  return ranks;
}

/// P(sum of ranks <= @p least) if each has either sign with the same probability.
double exactLowerTail(const std::vector<Rank>& ranks, long least) {
  std::vector<double> probability = {1.0};  // of each sum of doubled ranks
  for (const Rank& rank : ranks) {
    const auto step = static_cast<std::size_t>(rank.doubled);
    std::vector<double> next(probability.size() + step, 0.0);
    for (std::size_t s = 0; s < probability.size(); ++s) {
      next[s] += probability[s] / 2;
      next[s + step] += probability[s] / 2;
    }
    probability = std::move(next);
  }
  return std::accumulate(probability.begin(), probability.begin() + least + 1, 0.0);
}

}  // namespace

Interval wilson95(std::size_t count, std::size_t all) {
  if (all == 0) return {};
  constexpr double z = 1.959963984540054;
  const auto n = static_cast<double>(all);
  const double p = static_cast<double>(count) / n;
  const double middle = p + z * z / (2 * n);
  const double half = z * std::sqrt(p * (1 - p) / n + z * z / (4 * n * n));
  const double whole = 1 + z * z / n;
  return {count == 0 ? 0.0 : (middle - half) / whole, count == all ? 1.0 : (middle + half) / whole};
}

double quantileOf(std::vector<double> values, double share) {
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  std::ranges::sort(values);
  const double place = share * static_cast<double>(values.size() - 1);
  const auto below = static_cast<std::size_t>(place);
  const std::size_t above = std::min(below + 1, values.size() - 1);
  return values[below] + (place - static_cast<double>(below)) * (values[above] - values[below]);
}

double wilcoxonSignedRank(const std::vector<double>& differences) {
  double tieSum = 0.0;
  const std::vector<Rank> ranks = signedRanks(differences, tieSum);
  if (ranks.empty()) return 1.0;
  long all = 0;
  long positive = 0;
  for (const Rank& rank : ranks) {
    all += rank.doubled;
    if (rank.isPositive) positive += rank.doubled;
  }
  const long least = std::min(positive, all - positive);
  if (ranks.size() <= kMostExact) return std::min(1.0, 2 * exactLowerTail(ranks, least));
  const auto n = static_cast<double>(ranks.size());
  const double mean = n * (n + 1) / 4;
  const double variance = n * (n + 1) * (2 * n + 1) / 24 - tieSum / 48;
  const double off = std::max(0.0, mean - static_cast<double>(least) / 2 - 0.5);
  return std::erfc(off / std::sqrt(2 * variance));
}

double mcNemarExact(std::size_t better, std::size_t worse) {
  const std::size_t n = better + worse;
  const std::size_t least = std::min(better, worse);
  const auto logChoose = [&](std::size_t k) {
    return std::lgamma(static_cast<double>(n) + 1) - std::lgamma(static_cast<double>(k) + 1) -
           std::lgamma(static_cast<double>(n - k) + 1);
  };
  double tail = 0.0;
  for (std::size_t k = 0; k <= least; ++k)
    tail += std::exp(logChoose(k) - static_cast<double>(n) * std::log(2.0));
  return std::min(1.0, 2 * tail);
}

}  // namespace ortung::app

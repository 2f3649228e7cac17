#include "Statistics.hpp"

#include <algorithm>
#include <boost/math/distributions/binomial.hpp>
#include <boost/math/distributions/normal.hpp>
#include <cmath>
#include <numeric>
#include <utility>

namespace ortung::app {
namespace {

constexpr std::size_t kMostExact = 50;  ///< greatest number of differences for the exact test

struct Rank {
  long doubled;  ///< twice the rank, so that the mean of ties is a whole number
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
    const auto doubled = static_cast<long>(i + 1 + end);  // twice the mean of (i + 1), ..., end
    for (; i < end; ++i) ranks.push_back({doubled, some[i] > 0.0});
  }
  return ranks;
}

/// Returns P(sum of ranks <= @p least) if each rank has either sign with the same probability.
double exactLowerTail(const std::vector<Rank>& ranks, long least) {
  std::vector<double> probability = {1.0};  // probability of each sum of doubled ranks
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
  return 2.0 * cdf(complement(boost::math::normal(), off / std::sqrt(variance)));
}

double mcNemarExact(std::size_t better, std::size_t worse) {
  if (better + worse == 0) return 1.0;
  const boost::math::binomial chance(static_cast<double>(better + worse), 0.5);
  return std::min(1.0, 2.0 * cdf(chance, static_cast<double>(std::min(better, worse))));
}

}  // namespace ortung::app

#pragma once

#include <cstddef>
#include <vector>

namespace ortung::app {

struct Interval {
  double low = 0.0;
  double high = 1.0;
};

/// Between which shares the true one lies in 95 of 100 cases, @p count of @p all having succeeded
/// (Wilson, "Probable inference, the law of succession, and statistical inference", JASA 22, 1927).
/// [0, 1] of nothing.
Interval wilson95(std::size_t count, std::size_t all);

/// Quantile by linear interpolation between order statistics; NaN of nothing.
double quantileOf(std::vector<double> values, double share);

/// Two-sided p of the signed-rank test that paired @p differences are symmetric around 0
/// (Wilcoxon, "Individual comparisons by ranking methods", Biometrics 1, 1945): zeros are left out,
/// ties have their middle rank. Exact up to 50 differences, above that by the normal distribution
/// with corrections for ties and continuity. 1 of nothing.
double wilcoxonSignedRank(const std::vector<double>& differences);

/// Two-sided p of the exact test that of pairs that differ, as many are better as worse (McNemar,
/// "Note on the sampling error of the difference between correlated proportions", Psychometrika 12,
/// 1947; by the binomial distribution). 1 of nothing.
double mcNemarExact(std::size_t better, std::size_t worse);

}  // namespace ortung::app

#pragma once

#include <cstddef>
#include <vector>

namespace ortung::app {

/// Two-sided p of the signed-rank test that paired @p differences are symmetric around 0
/// (Wilcoxon, "Individual comparisons by ranking methods", Biometrics 1, 1945): zeros are left out,
/// ties have their middle rank. Exact up to 50 differences, above that by the normal distribution
/// with corrections for ties and continuity. 1 without differences.
double wilcoxonSignedRank(const std::vector<double>& differences);

/// Two-sided p of the exact test that of pairs that differ, as many are better as worse (McNemar,
/// "Note on the sampling error of the difference between correlated proportions", Psychometrika 12,
/// 1947; by the binomial distribution). 1 without pairs.
double mcNemarExact(std::size_t better, std::size_t worse);

}  // namespace ortung::app

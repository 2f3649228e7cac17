#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "Statistics.hpp"
#include "ortung/base/Statistics.hpp"

namespace ortung::app {
namespace {

// Newcombe, "Two-sided confidence intervals for the single proportion: comparison of seven
// methods", Statistics in Medicine 17 (1998), table I, method 3.
TEST(Statistics, WilsonIntervalsAreThePublishedOnes) {
  const auto expectInterval = [](std::size_t count, std::size_t all, double low, double high) {
    const Interval found = wilson(count, all);
    EXPECT_NEAR(found.low, low, 5e-5) << count << " of " << all;
    EXPECT_NEAR(found.high, high, 5e-5) << count << " of " << all;
  };
  expectInterval(81, 263, 0.2553, 0.3662);
  expectInterval(15, 148, 0.0624, 0.1605);
  expectInterval(0, 20, 0.0, 0.1611);
  expectInterval(1, 29, 0.0061, 0.1718);
}

TEST(Statistics, WilsonIntervalOfAllIsThatOfNoneTurnedRound) {
  EXPECT_EQ(wilson(20, 20).high, 1.0);
  EXPECT_NEAR(wilson(20, 20).low, 1.0 - wilson(0, 20).high, 1e-12);
  EXPECT_EQ(wilson(0, 0).low, 0.0);
  EXPECT_EQ(wilson(0, 0).high, 1.0);
}

TEST(Statistics, QuantilesInterpolateBetweenOrderStatistics) {
  EXPECT_DOUBLE_EQ(quantile({3, 1, 2, 4}, 0.5), 2.5);
  EXPECT_DOUBLE_EQ(quantile({3, 1, 2, 4}, 0.0), 1.0);
  EXPECT_DOUBLE_EQ(quantile({3, 1, 2, 4}, 1.0), 4.0);
  EXPECT_TRUE(std::isnan(quantile({}, 0.5)));
}

// Hollander and Wolfe, "Nonparametric Statistical Methods", example 3.1 (depression of nine
// patients before and after): T+ = 40 of 45, two-sided p = 20/512.
TEST(Statistics, SignedRankTestIsExactForFewPairs) {
  const std::vector<double> before = {1.83, 0.50, 1.62, 2.48, 1.68, 1.88, 1.55, 3.06, 1.30};
  const std::vector<double> after = {0.878, 0.647, 0.598, 2.05, 1.06, 1.29, 1.06, 3.14, 1.29};
  std::vector<double> differences;
  for (std::size_t i = 0; i < before.size(); ++i) differences.push_back(before[i] - after[i]);
  EXPECT_NEAR(wilcoxonSignedRank(differences), 20.0 / 512, 1e-12);
  for (double& d : differences) d = -d;
  EXPECT_NEAR(wilcoxonSignedRank(differences), 20.0 / 512, 1e-12);
}

// The critical values of the usual tables (two-sided 0.05): n = 6: 0, n = 10: 8, n = 20: 52.
TEST(Statistics, SignedRankTestHasTheCriticalValuesOfTheTables) {
  const auto withSum = [](int n, int sum) {  // negative ranks that sum up to it
    std::vector<double> differences;
    for (int rank = n; rank >= 1; --rank) {
      const bool isNegative = rank <= sum;
      if (isNegative) sum -= rank;
      differences.push_back(isNegative ? -rank : rank);
    }
    return wilcoxonSignedRank(differences);
  };
  for (const auto& [n, critical] : {std::pair{6, 0}, {10, 8}, {20, 52}, {30, 137}, {50, 434}}) {
    EXPECT_LE(withSum(n, critical), 0.05) << n;
    EXPECT_GT(withSum(n, critical + 1), 0.05) << n;
  }
}

// By hand: all signs of {1, 1, 2} with ranks 1.5, 1.5, 3: T = 0 has 1 of 8 cases, so p = 2/8.
TEST(Statistics, SignedRankTestGivesTiesTheirMiddleRankAndLeavesOutZeros) {
  EXPECT_DOUBLE_EQ(wilcoxonSignedRank({1, 1, 2}), 0.25);
  EXPECT_DOUBLE_EQ(wilcoxonSignedRank({0, 1, 0, 1, 2, 0}), 0.25);
  EXPECT_DOUBLE_EQ(wilcoxonSignedRank({-1, 1, 2}), 0.75);  // T = 1.5: 3 of 8
  EXPECT_DOUBLE_EQ(wilcoxonSignedRank({}), 1.0);
  EXPECT_DOUBLE_EQ(wilcoxonSignedRank({0, 0}), 1.0);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_DOUBLE_EQ(wilcoxonSignedRank({1, nan, 1, 2}), 0.25);
}

// Both ways must agree where they meet: 50 pairs are exact, 51 are not.
TEST(Statistics, SignedRankTestOfManyPairsAgreesWithTheExactOne) {
  std::vector<double> differences;
  for (int i = 1; i <= 50; ++i) differences.push_back(i % 3 == 0 ? -i : i);
  const double exact = wilcoxonSignedRank(differences);
  differences.push_back(1e-9);  // rank 1, and all others one more
  EXPECT_NEAR(wilcoxonSignedRank(differences), exact, 0.1 * exact);
}

// Doubled tails of the binomial distribution with 1/2: 9 of 10 has 11/1024.
TEST(Statistics, McNemarTestIsTheBinomialOne) {
  EXPECT_NEAR(mcNemarExact(9, 1), 22.0 / 1024, 1e-12);
  EXPECT_NEAR(mcNemarExact(1, 9), 22.0 / 1024, 1e-12);
  EXPECT_NEAR(mcNemarExact(5, 0), 2.0 / 32, 1e-12);
  EXPECT_DOUBLE_EQ(mcNemarExact(5, 5), 1.0);
  EXPECT_DOUBLE_EQ(mcNemarExact(0, 0), 1.0);
  EXPECT_NEAR(mcNemarExact(600, 400), 2.73e-10, 0.02e-10);
}

}  // namespace
}  // namespace ortung::app

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "ortung/benchmark/Rates.hpp"

namespace ortung {
namespace {

// Ends of the interval are the shares p0 from which the observed one is 1.96 standard deviations of
// p0 away (Wilson 1927): put in, they must give that.
TEST(Rates, EndsOfWilsonsIntervalAreAtTheirDistance) {
  for (const std::uint64_t n : {1u, 7u, 100u, 10000u})
    for (std::uint64_t hits = 0; hits <= n; hits += std::max<std::uint64_t>(n / 7, 1)) {
      const Interval interval = wilson(hits, n);
      const double p = static_cast<double>(hits) / static_cast<double>(n);
      EXPECT_DOUBLE_EQ(interval.value, p);
      for (const double end : {interval.low, interval.high}) {
        if (end == 0.0 || end == 1.0) continue;
        const double sigma = std::sqrt(end * (1.0 - end) / static_cast<double>(n));
        EXPECT_NEAR(std::abs(p - end) / sigma, 1.959964, 1e-5) << hits << "/" << n;
      }
      EXPECT_LE(interval.low, p);
      EXPECT_GE(interval.high, p);
    }
}

TEST(Rates, NoTrialsSayNothing) {
  EXPECT_EQ(wilson(0, 0).low, 0.0);
  EXPECT_EQ(wilson(0, 0).high, 1.0);
  EXPECT_EQ(wilson(0, 10).low, 0.0);
  EXPECT_NEAR(wilson(0, 10).high, 0.2775, 1e-4);  // = z^2 / (n + z^2)
}

TEST(Rates, NoPairsAndNoDrawsMayBeAnything) {
  for (const Interval& interval :
       {pairedBootstrap({}, 1), pairedBootstrap(std::vector<int>{1, 1}, 1, 0),
        pairedBootstrap({}, 1, 0)}) {
    EXPECT_EQ(interval.value, 0.0);
    EXPECT_EQ(interval.low, -1.0);
    EXPECT_EQ(interval.high, 1.0);
  }
}

// The mean of n pairs has the standard deviation of one pair divided by sqrt(n).
TEST(Rates, BootstrapIsAsWideAsTheCentralLimitSays) {
  std::vector<int> differences;
  for (int i = 0; i < 1000; ++i) differences.push_back(i % 10 < 5 ? 0 : (i % 10 < 9 ? 1 : -1));
  const Interval interval = pairedBootstrap(differences, 3);
  EXPECT_DOUBLE_EQ(interval.value, 0.3);
  const double sigma = std::sqrt((0.5 - 0.09) / 1000.0);
  EXPECT_NEAR(interval.low, 0.3 - 1.96 * sigma, 0.3 * sigma);
  EXPECT_NEAR(interval.high, 0.3 + 1.96 * sigma, 0.3 * sigma);
}

TEST(Rates, BootstrapIsTheSameForASeed) {
  const std::vector<int> differences = {1, 0, 0, -1, 1, 1, 0};
  const Interval a = pairedBootstrap(differences, 5);
  const Interval b = pairedBootstrap(differences, 5);
  EXPECT_EQ(a.low, b.low);
  EXPECT_EQ(a.high, b.high);
  // Where all pairs say the same there is nothing to draw.
  const Interval same = pairedBootstrap(std::vector<int>(50, -1), 1);
  EXPECT_EQ(same.low, -1.0);
  EXPECT_EQ(same.high, -1.0);
}

// Of 1001 values, the 25th from either end.
TEST(Rates, PercentilesAreAmongTheValues) {
  std::vector<double> drawn;
  for (int i = 0; i <= 1000; ++i) drawn.push_back(i * 8 % 1001);
  const Interval found = percentiles(3.0, drawn);
  EXPECT_EQ(found.value, 3.0);
  EXPECT_EQ(found.low, 25.0);
  EXPECT_EQ(found.high, 975.0);
}

}  // namespace
}  // namespace ortung

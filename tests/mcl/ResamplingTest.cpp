#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <limits>
#include <numeric>

#include "Resampling.hpp"
#include "Seeded.hpp"
#include "ortung/base/Random.hpp"
#include "ortung/base/Workers.hpp"

namespace ortung {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
using Weights = std::vector<double>;
using Indices = std::vector<std::uint32_t>;

TEST(Normalized, ScalesToOneWithoutOverflow) {
  const std::vector<float> logs = {-1000.0F, -1000.0F + std::log(3.0F)};
  const Weights weights = normalized(logs);
  EXPECT_NEAR(weights[0], 0.25, 1e-4);  // a float near 1000 knows ln 3 to 6e-5
  EXPECT_NEAR(weights[1], 0.75, 1e-4);
  EXPECT_NEAR(normalized(std::vector<float>{3e38F, 3e38F})[0], 0.5, 1e-12);
}

TEST(Normalized, GivesNothingToWhatIsNotFinite) {
  EXPECT_EQ(normalized(std::vector<float>{0.0F, kNan, -kInfinity, kInfinity}),
            (Weights{1, 0, 0, 0}));
}

TEST(Normalized, IsEvenWhereAllIsLost) {
  EXPECT_EQ(normalized(std::vector<float>{-kInfinity, -kInfinity, kNan, -kInfinity}),
            (Weights{0.25, 0.25, 0.25, 0.25}));
}

TEST(EffectiveSamples, CountsEqualWeights) {
  EXPECT_DOUBLE_EQ(effectiveSamples(Weights{0.25, 0.25, 0.25, 0.25}), 4.0);
  EXPECT_DOUBLE_EQ(effectiveSamples(Weights{0, 1, 0}), 1.0);
  EXPECT_DOUBLE_EQ(effectiveSamples(Weights{0.5, 0.25, 0.25}), 1 / 0.375);
}

TEST(LowVariance, FollowsTheTextbookExample) {
  // Pointers at 0.1, 0.35, 0.6, 0.85 of the cumulated weights 0.2, 0.2, 0.7, 1.
  EXPECT_EQ(lowVariance(Weights{0.2, 0.0, 0.5, 0.3}, 4, 0.4), (Indices{0, 2, 2, 3}));
  EXPECT_EQ(lowVariance(Weights{0.2, 0.0, 0.5, 0.3}, 1, 0.95), Indices{3});
}

RC_GTEST_PROP(LowVarianceProperty, TakesEachSampleItsShareUpToOne, ()) {
  const auto raw = *rc::gen::suchThat(
      rc::gen::container<std::vector<int>>(rc::gen::inRange(0, 50)),
      [](const std::vector<int>& v) { return std::accumulate(v.begin(), v.end(), 0) > 0; });
  const auto n = static_cast<std::size_t>(*rc::gen::inRange(1, 200));
  const double offset = *rc::gen::inRange(0, 1000) / 1000.0;
  const double sum = std::accumulate(raw.begin(), raw.end(), 0);
  Weights weights;
  for (const int r : raw) weights.push_back(r / sum);
  const Indices indices = lowVariance(weights, n, offset);
  RC_ASSERT(indices.size() == n);
  RC_ASSERT(std::is_sorted(indices.begin(), indices.end()));
  std::vector<double> times(raw.size(), 0.0);
  for (const std::uint32_t i : indices) times.at(i) += 1.0;
  for (std::size_t i = 0; i < raw.size(); ++i) {
    RC_ASSERT(std::abs(times[i] - static_cast<double>(n) * weights[i]) < 1.0 + 1e-9);
    RC_ASSERT(raw[i] > 0 || times[i] == 0.0);
  }
}

TEST(LowVariance, NeverTakesATrailingSampleWithoutWeight) {
  // Weights that sum to a little less than 1, as rounding leaves them.
  EXPECT_EQ(lowVariance(Weights{0.5, 0.5 - 1e-9, 0.0, 0.0}, 2, 1.0 - 1e-12), (Indices{0, 1}));
}

/// The textbook's loop (Thrun, Burgard, Fox, table 4.4), one sample after the other.
Indices oneByOne(const Weights& weights, std::size_t n, double offset) {
  Indices indices;
  double sum = 0.0;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    sum += weights[i];
    while (indices.size() < n &&
           (static_cast<double>(indices.size()) + offset) / static_cast<double>(n) < sum)
      indices.push_back(static_cast<std::uint32_t>(i));
  }
  return indices;
}

TEST(LowVariance, DrawsLargeSetsAsTheTextbookDoesWithAnyThreads) {
  Random random(2);
  Workers workers(3);
  for (const std::size_t size : {1U, 511U, 512U, 513U, 2047U, 2048U, 2049U, 9001U, 40000U}) {
    std::vector<float> logs(size);
    for (float& w : logs) w = static_cast<float>(4.0 * random.gaussian());
    // Long stretches that weigh nothing, and one sample that weighs as much as many.
    for (std::size_t i = size / 5; i < size / 2; ++i) logs[i] = -kInfinity;
    logs[size / 7] = 20.0F;
    const Weights weights = normalized(logs);
    EXPECT_EQ(normalized(logs, &workers), weights);
    for (const std::size_t n : {1UL, 64UL, 2000UL, size, 3 * size}) {
      const double offset = random.uniform();
      const Indices expected = oneByOne(weights, n, offset);
      ASSERT_EQ(expected.size(), n) << "of " << size << " samples";
      EXPECT_EQ(lowVariance(weights, n, offset), expected) << n << " of " << size << " samples";
      EXPECT_EQ(lowVariance(weights, n, offset, &workers), expected);
    }
  }
}

TEST(LowVariance, KeepsTheMean) {
  Random random(1);
  std::vector<float> logs(20000);
  for (float& w : logs) w = static_cast<float>(2.0 * random.gaussian());
  const Weights weights = normalized(logs);
  double expected = 0.0;
  for (std::size_t i = 0; i < weights.size(); ++i) expected += weights[i] * static_cast<double>(i);
  double found = 0.0;
  for (const std::uint32_t i : lowVariance(weights, 20000, random.uniform())) found += i / 20000.0;
  EXPECT_NEAR(found, expected, 1.0) << "of 20000: neighbours stand in for each other";
}

TEST(Add, GivesFreshSamplesTheirShareAndKeepsWeightsAmongBoth) {
  SampleSet set;
  set.resize(3);
  set.x = {1.0F, 2.0F, 3.0F};
  set.logWeight = {0.0F, std::log(3.0F), -std::numeric_limits<float>::infinity()};
  SampleSet fresh;
  fresh.resize(2);
  fresh.x = {10.0F, 11.0F};
  fresh.y = {20.0F, 21.0F};
  fresh.theta = {0.1F, 0.2F};
  fresh.logWeight = {-50.0F, -50.0F + std::log(4.0F)};
  add(set, fresh, 0.8);
  EXPECT_EQ(set.x, (std::vector<float>{1.0F, 2.0F, 3.0F, 10.0F, 11.0F}));
  EXPECT_EQ(set.y[4], 21.0F);
  EXPECT_EQ(set.theta[3], 0.1F);
  const std::vector<double> weights = normalized(set.logWeight);
  const std::vector<double> expected = {0.05, 0.15, 0.0, 0.16, 0.64};
  for (std::size_t i = 0; i < 5; ++i) EXPECT_NEAR(weights[i], expected[i], 1e-6) << i;
}

TEST(LogMean, IsThatOfExponentials) {
  const std::vector<float> values = {-1000.0F, -1000.0F + std::log(3.0F)};
  EXPECT_NEAR(logMean(values), -1000.0 + std::log(2.0), 1e-4);
  EXPECT_NEAR(logMean(std::vector<double>{0.75, 0.25}, values), -1000.0 + std::log(1.5), 1e-4);
}

TEST(TemperFor, LeavesEvenWeightsAlone) {
  EXPECT_EQ(temperFor(std::vector<float>(10, -3.0F), 9.99), 1.0);
  EXPECT_EQ(temperFor(std::vector<float>{0.0F, -0.01F}, 1.5), 1.0);
}

TEST(TemperFor, GivesAsManyEffectiveSamplesAsAsked) {
  Random random(2);
  std::vector<float> logs(5000);
  for (float& w : logs) w = static_cast<float>(-200.0 * random.uniform());
  for (const double least : {10.0, 100.0, 500.0, 1000.0, 4000.0}) {
    const double exponent = temperFor(logs, least);
    const auto worth = [&](double e) {
      std::vector<float> scaled;
      for (const float w : logs) scaled.push_back(static_cast<float>(e) * w);
      return effectiveSamples(normalized(scaled));
    };
    EXPECT_GE(worth(exponent), least);
    EXPECT_TRUE(exponent == 1.0 || worth(exponent + 0.001) < least) << "no flatter than needed";
  }
}

TEST(TemperFor, SurvivesWeightsThatAreNotFinite) {
  const double exponent = temperFor(std::vector<float>{0.0F, -kInfinity, kNan, -1000.0F}, 3.0);
  EXPECT_GT(exponent, 0.0);
  EXPECT_LE(exponent, 1.0);
}

}  // namespace
}  // namespace ortung

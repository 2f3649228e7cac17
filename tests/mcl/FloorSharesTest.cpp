// How a belief is shared among floors, computed by hand.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numeric>

#include "FloorShares.hpp"

namespace ortung {
namespace {

Building house() {
  return {{{"ground", 0.0, -5.0, 20.0}, {"first", 30.0, 20.0, 50.0}, {"attic", 60.0, 50.0, 80.0}},
          {}};
}

/// Samples of equal weight at these places.
SampleSet samplesAt(const std::vector<float>& x) {
  SampleSet samples;
  samples.resize(x.size());
  samples.x = x;
  return samples;
}

TEST(FloorShares, ShareABeliefByItsWeights) {
  SampleSet samples = samplesAt({1.0F, 32.0F, 33.0F, 70.0F});
  samples.logWeight = {std::log(4.0F), std::log(2.0F), std::log(1.0F), std::log(1.0F)};
  const auto shares = floorShares(house(), samples);
  ASSERT_EQ(shares.size(), 3U);
  EXPECT_NEAR(shares[0], 0.5, 1e-6);
  EXPECT_NEAR(shares[1], 0.375, 1e-6);
  EXPECT_NEAR(shares[2], 0.125, 1e-6);
  samples.logWeight = {-2000.0F, -2000.0F, -2000.0F, -2000.0F};  // e^-2000 is no number
  EXPECT_NEAR(floorShares(house(), samples)[1], 0.5, 1e-6);
}

TEST(FloorShares, AreNoneWithoutSamplesOrWithThoseThatAreNoNumbers) {
  EXPECT_EQ(floorShares(house(), {}), std::vector<double>(3, 0.0));
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  SampleSet samples = samplesAt({kNan, 31.0F});
  samples.logWeight = {0.0F, 0.0F};
  EXPECT_EQ(floorShares(house(), samples), (std::vector<double>{0.0, 1.0, 0.0}));
  samples.logWeight = {kNan, kNan};
  EXPECT_EQ(floorShares(house(), samples), std::vector<double>(3, 0.0));
}

TEST(FloorShares, OtherFloorsHaveTheGreaterOfTwo) {
  const auto expectNear = [](const std::vector<double>& a, const std::vector<double>& b) {
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t i = 0; i < a.size(); ++i) EXPECT_NEAR(a[i], b[i], 1e-12) << i;
  };
  expectNear(greaterBeside(0, {1.0, 0.0, 0.0}, {0.5, 0.5, 0.0}), {0.5, 0.5, 0.0});
  expectNear(greaterBeside(0, {0.5, 0.5, 0.0}, {1.0, 0.0, 0.0}), {0.5, 0.5, 0.0});
  expectNear(greaterBeside(2, {0.2, 0.1, 0.7}, {0.0, 0.3, 0.7}), {0.2, 0.3, 0.5});
  const auto most = greaterBeside(0, {0.0, 0.9, 0.1}, {0.2, 0.0, 0.8});
  expectNear(most, {0.0, 0.9 / 1.7, 0.8 / 1.7});
  EXPECT_NEAR(std::accumulate(most.begin(), most.end(), 0.0), 1.0, 1e-12);
}

}  // namespace
}  // namespace ortung

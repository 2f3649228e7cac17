// Residuals that are drawn with known noise: what was drawn with is found, with errors that are
// true.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "ortung/base/Random.hpp"
#include "ortung/study/NoiseFit.hpp"

namespace ortung {
namespace {

constexpr ByNoiseTerm<bool> kRangeBiasAlone = {true};

/// Ranges from 0.5 to 7.5 m, ten a second.
std::vector<NoiseResidual> ranges(std::uint64_t seed, std::size_t count, double bias,
                                  double outliers) {
  Random random(seed);
  std::vector<NoiseResidual> all;
  for (std::size_t i = 0; i < count; ++i) {
    NoiseResidual r;
    r.stamp = static_cast<Timestamp>(i) * 100'000;
    r.range = 0.5 + 7.0 * random.uniform();
    r.by[0] = 1.0;
    r.residual = random.uniform() < outliers ? 8.0 * random.uniform() - 4.0
                                             : bias + (0.02 + 0.03 * r.range) * random.gaussian();
    all.push_back(r);
  }
  return all;
}

TEST(NoiseFit, StandardErrorsAreThoseOfManyRepetitions) {
  constexpr int kRuns = 60;
  double sum = 0.0;
  double squares = 0.0;
  double claimed = 0.0;
  double sigma = 0.0;
  double perMetre = 0.0;
  double outliers = 0.0;
  for (int run = 0; run < kRuns; ++run) {
    const NoiseFit fit =
        fitNoise(ranges(static_cast<std::uint64_t>(run) + 1, 2000, 0.05, 0.1), kRangeBiasAlone);
    ASSERT_TRUE(fit.isKnown[0]);
    sum += fit.terms[0].value / kRuns;
    squares += std::pow(fit.terms[0].value - 0.05, 2) / kRuns;
    claimed += fit.terms[0].error / kRuns;
    sigma += fit.distances.sigma.value / kRuns;
    perMetre += fit.distances.sigmaPerMetre.value / kRuns;
    outliers += fit.distances.outliers.value / kRuns;
  }
  EXPECT_NEAR(sum, 0.05, 4 * claimed / std::sqrt(kRuns));
  // Of 60 draws a standard deviation is known to 9 %.
  EXPECT_NEAR(claimed / std::sqrt(squares), 1.0, 0.3);
  EXPECT_NEAR(sigma, 0.02, 0.002);
  EXPECT_NEAR(perMetre, 0.03, 0.001);
  EXPECT_NEAR(outliers, 0.1, 0.005);
}

// What is wrong for 10 s counts once: 400 blocks of 25 values that err alike.
TEST(NoiseFit, ValuesThatErrAlikeCountForFewer) {
  std::vector<NoiseResidual> all = ranges(3, 10'000, 0.0, 0.0);
  Random random(4);
  double common = 0.0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (i % 100 == 0) common = 0.1 * random.gaussian();
    all[i].range = 0.0;
    all[i].residual = common + 0.02 * random.gaussian();
  }
  const NoiseFit fit = fitNoise(all, kRangeBiasAlone);
  // The mean of 100 blocks with 0.1 m each.
  EXPECT_NEAR(fit.terms[0].error, 0.01, 0.003);
  EXPECT_NEAR(fit.distances.independent, 0.01, 0.006);
  EXPECT_FALSE(fit.isKnown[0]);
  EXPECT_EQ(fit.terms[0].value, 0.0);
}

TEST(NoiseFit, RefusesAHandfulOfValues) {
  EXPECT_THROW(fitNoise(ranges(1, 49, 0.0, 0.0), kRangeBiasAlone), std::invalid_argument);
}

}  // namespace
}  // namespace ortung

// Readings that come in by degrees, against integrals in closed form.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "Annealing.hpp"
#include "Resampling.hpp"
#include "ortung/base/Pose2.hpp"

namespace ortung {
namespace {

using Vector = std::array<double, 3>;
constexpr double kTurn = 2.0 * std::numbers::pi;

/// exp(-r^2 / 2) of independent residuals.
Annealing::Weigh gaussian(const Vector& mean, const Vector& sigma) {
  return [=](const SampleSet& set, std::vector<float>& out) {
    out.resize(set.size());
    for (std::size_t i = 0; i < set.size(); ++i) {
      const double x = (static_cast<double>(set.x[i]) - mean[0]) / sigma[0];
      const double y = (static_cast<double>(set.y[i]) - mean[1]) / sigma[1];
      const double t = wrapAngle(static_cast<double>(set.theta[i]) - mean[2]) / sigma[2];
      out[i] = static_cast<float>(-0.5 * (x * x + y * y + t * t));
    }
  };
}

struct Moments {
  Vector mean{};
  PoseCovariance covariance{};
  double sigma(std::size_t k) const { return std::sqrt(covariance[4 * k]); }
};

Moments momentsOf(const SampleSet& set) {
  const auto weights = normalized(set.logWeight);
  Moments m;
  const auto at = [&set](std::size_t i) {
    return Vector{static_cast<double>(set.x[i]), static_cast<double>(set.y[i]),
                  wrapAngle(static_cast<double>(set.theta[i]))};
  };
  for (std::size_t i = 0; i < set.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k) m.mean[k] += weights[i] * at(i)[k];
  for (std::size_t i = 0; i < set.size(); ++i)
    for (std::size_t k = 0; k < 9; ++k)
      m.covariance[k] +=
          weights[i] * (at(i)[k / 3] - m.mean[k / 3]) * (at(i)[k % 3] - m.mean[k % 3]);
  return m;
}

SampleSet evenly(double width, double height, std::size_t n, std::uint64_t seed) {
  Random random(seed);
  SampleSet set;
  set.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    set.x[i] = static_cast<float>(random.uniform(-width / 2, width / 2));
    set.y[i] = static_cast<float>(random.uniform(-height / 2, height / 2));
    set.theta[i] = static_cast<float>(random.uniform(-kTurn / 2, kTurn / 2));
  }
  return set;
}

// The mean of exp(-r^2 / 2) over the box is (2 pi)^(3/2) times the product of sigmas by its volume.
TEST(Annealing, OfAFlatPriorFindsMassAndShapeOfAGaussian) {
  const Vector mean = {3.0, -1.5, 1.0};
  for (const Vector& sigma :
       {Vector{0.5, 0.5, 0.3}, Vector{0.2, 0.1, 0.1}, Vector{0.05, 0.03, 0.02}}) {
    double evidence = 0.0;
    for (std::uint64_t seed = 1; seed <= 4; ++seed) {
      const auto drawn = Annealing(gaussian(mean, sigma), nullptr)
                             .draw(evenly(20, 10, 100000, seed), 4000, Random(seed, 7));
      ASSERT_EQ(drawn.samples.size(), 4000u);
      evidence += drawn.logEvidence / 4.0;
      const Moments m = momentsOf(drawn.samples);
      for (std::size_t k = 0; k < 3; ++k) {
        EXPECT_NEAR(m.mean[k], mean[k], 0.15 * sigma[k]) << sigma[0] << ", " << k;
        EXPECT_NEAR(m.sigma(k), sigma[k], 0.12 * sigma[k]) << sigma[0] << ", " << k;
      }
    }
    const double mass = std::pow(kTurn, 1.5) * sigma[0] * sigma[1] * sigma[2];
    EXPECT_NEAR(evidence, std::log(mass / (20 * 10 * kTurn)), 0.2) << sigma[0];
  }
}

// What the exponents lack of 1 is in the weights, wherever the time is over.
TEST(Annealing, OfWhichTheRestIsLeftOutIsTheSameDistribution) {
  const Vector mean = {3.0, -1.5, 1.0};
  const Vector sigma = {0.5, 0.5, 0.3};
  const Annealing annealing(gaussian(mean, sigma), nullptr);
  const SampleSet from = evenly(20, 10, 100000, 1);
  const double mass = std::pow(kTurn, 1.5) * sigma[0] * sigma[1] * sigma[2];
  std::vector<double> worth;
  for (const int last : {0, 60, 1000}) {  // before the first pose, within a step, never
    int looks = 0;
    const auto drawn = annealing.draw(from, 20000, Random(1, 7), [&] { return looks++ >= last; });
    ASSERT_EQ(drawn.samples.size(), 20000u);
    EXPECT_NEAR(drawn.logEvidence, std::log(mass / (20 * 10 * kTurn)), 0.2) << last;
    const Moments m = momentsOf(drawn.samples);
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_NEAR(m.mean[k], mean[k], 0.2 * sigma[k]) << last << ", " << k;
      EXPECT_NEAR(m.sigma(k), sigma[k], 0.2 * sigma[k]) << last << ", " << k;
    }
    worth.push_back(effectiveSamples(normalized(drawn.samples.logWeight)));
  }
  EXPECT_LT(worth[0], 0.5 * worth[2]) << "time is worth something";
}

TEST(Annealing, OfWhatTellsNothingHasNoEvidenceAndLeavesThePrior) {
  const auto flat = [](const SampleSet& set, std::vector<float>& out) {
    out.assign(set.size(), -2.0F);
  };
  const auto drawn = Annealing(flat, [](float x, float y, float) {
                       return std::abs(x) < 10 && std::abs(y) < 5;
                     }).draw(evenly(20, 10, 20000, 3), 5000, Random(1));
  EXPECT_NEAR(drawn.logEvidence, -2.0, 1e-4);
  const Moments m = momentsOf(drawn.samples);
  EXPECT_NEAR(m.sigma(0), 20 / std::sqrt(12.0), 0.1);
  EXPECT_NEAR(m.sigma(1), 10 / std::sqrt(12.0), 0.06);
}

TEST(Annealing, StaysWhereItMay) {
  const auto right = [](float x, float, float) { return x > 0.0F; };
  SampleSet from = evenly(4, 4, 20000, 5);
  for (float& x : from.x) x = std::abs(x) + 1e-3F;
  const auto drawn =
      Annealing(gaussian({-0.5, 0, 0}, {0.3, 0.3, 0.3}), right).draw(from, 1000, Random(2));
  for (const float x : drawn.samples.x) ASSERT_GT(x, 0.0F);
}

struct Prior {
  Vector mean;
  Vector sigma;
  SampleSet drawn(std::size_t n, std::uint64_t seed) const {
    Random random(seed);
    SampleSet set;
    set.resize(n);
    for (std::size_t i = 0; i < n; ++i) {
      set.x[i] = static_cast<float>(mean[0] + sigma[0] * random.gaussian());
      set.y[i] = static_cast<float>(mean[1] + sigma[1] * random.gaussian());
      set.theta[i] = static_cast<float>(mean[2] + sigma[2] * random.gaussian());
    }
    return set;
  }
  PoseCovariance covariance() const {
    return {sigma[0] * sigma[0], 0, 0, 0, sigma[1] * sigma[1], 0, 0, 0, sigma[2] * sigma[2]};
  }
};

// A Gaussian belief and a Gaussian reading of all three: Kalman's update, and the evidence
// sqrt(R / (P + R)) exp(-d^2 / 2 (P + R)) of each.
TEST(Annealing, OfABeliefIsAKalmanUpdate) {
  const Prior prior{{1.0, 2.0, 0.5}, {0.6, 0.4, 0.3}};
  const Vector offset = {0.6, -0.4, 0.2};
  for (const double width : {1.0, 0.4, 0.15}) {
    Vector reading{};
    Vector sigma{};
    double evidence = 0.0;
    for (std::size_t k = 0; k < 3; ++k) {
      reading[k] = prior.mean[k] + offset[k];
      sigma[k] = width * prior.sigma[k];
      const double sum = prior.sigma[k] * prior.sigma[k] + sigma[k] * sigma[k];
      evidence += std::log(sigma[k]) - 0.5 * std::log(sum) - 0.5 * offset[k] * offset[k] / sum;
    }
    double found = 0.0;
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
      const auto drawn = Annealing(gaussian(reading, sigma), prior.covariance(), 20000)
                             .draw(prior.drawn(20000, seed), 4000, Random(seed, 9));
      const Moments m = momentsOf(drawn.samples);
      for (std::size_t k = 0; k < 3; ++k) {
        const double p = prior.sigma[k] * prior.sigma[k];
        const double gain = p / (p + sigma[k] * sigma[k]);
        const double expected = prior.mean[k] + gain * offset[k];
        const double left = std::sqrt((1.0 - gain) * p);
        EXPECT_NEAR(m.mean[k], expected, 0.15 * left) << width << ", " << k;
        EXPECT_NEAR(m.sigma(k), left, 0.12 * left) << width << ", " << k;
      }
      found += drawn.logEvidence / 3.0;
    }
    EXPECT_NEAR(found, evidence, 0.25) << width;
  }
}

// What is known of x alone leaves y and heading as they were known: climbing does not forget them.
TEST(Annealing, OfABeliefKeepsWhatTheReadingDoesNotTell) {
  const Prior prior{{0, 0, 0}, {0.5, 0.05, 0.03}};
  const auto drawn = Annealing(gaussian({0.3, 0, 0}, {0.02, 1e3, 1e3}), prior.covariance(), 5000)
                         .draw(prior.drawn(5000, 4), 2000, Random(3));
  const Moments m = momentsOf(drawn.samples);
  EXPECT_NEAR(m.mean[0], 0.3, 0.01);
  EXPECT_NEAR(m.sigma(0), 0.02, 0.005);
  // Known to 0.05 m; each sample stands for surroundings of 0.06 m and 0.03 rad at least.
  EXPECT_GT(m.sigma(1), 0.045);
  EXPECT_LT(m.sigma(1), std::hypot(0.05, 0.07));
  EXPECT_GT(m.sigma(2), 0.027);
  EXPECT_LT(m.sigma(2), std::hypot(0.03, 0.035));
}

TEST(Annealing, GivesTheSameForTheSameNumbers) {
  const Annealing annealing(gaussian({1, 1, 1}, {0.1, 0.1, 0.1}), nullptr);
  const auto one = annealing.draw(evenly(4, 4, 5000, 1), 300, Random(5));
  const auto two = annealing.draw(evenly(4, 4, 5000, 1), 300, Random(5));
  EXPECT_EQ(one.samples.x, two.samples.x);
  EXPECT_EQ(one.logEvidence, two.logEvidence);
  EXPECT_NE(one.samples.x, annealing.draw(evenly(4, 4, 5000, 1), 300, Random(6)).samples.x);
}

}  // namespace
}  // namespace ortung

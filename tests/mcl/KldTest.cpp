#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "Kld.hpp"
#include "ortung/base/Random.hpp"
#include "ortung/base/Workers.hpp"

namespace ortung {
namespace {

constexpr double kPi = std::numbers::pi;

struct Poses {
  std::vector<float> x;
  std::vector<float> y;
  std::vector<float> theta;
  void add(double px, double py, double ptheta) {
    x.push_back(static_cast<float>(px));
    y.push_back(static_cast<float>(py));
    theta.push_back(static_cast<float>(ptheta));
  }
  SampleView view() const { return {x, y, theta}; }
};

MclConfig wide() {
  MclConfig config;
  config.minSamples = 10;
  config.maxSamples = 1000000;
  return config;
}

// n = chi^2(k - 1, 0.99) / (2 * 0.02) (Fox 2003, eq. 5); quantiles of the chi-squared distribution
// from tables. Fox's eq. 7 replaces it by Wilson and Hilferty's approximation: within 0.3 %.
TEST(KldSamples, AreThoseOfTheChiSquaredQuantile) {
  const std::pair<std::size_t, double> table[] = {
      {11, 23.209}, {31, 50.892}, {51, 76.154}, {101, 135.807}};
  for (const auto& [bins, quantile] : table) {
    const double expected = quantile / 0.04;
    EXPECT_NEAR(static_cast<double>(kldSamples(wide(), bins)), expected, 0.003 * expected) << bins;
  }
}

// By hand, k = 100: a = 2 / (9 * 99) = 0.0022447, 1 - a + sqrt(a) 2.33 = 1.1081465,
// cubed 1.360798, times 99 / 0.04 = 2475: 3367.97.
TEST(KldSamples, FollowFoxsFormula) {
  EXPECT_NEAR(static_cast<double>(kldSamples(wide(), 100)), 3368.0, 1.0);
}

TEST(KldSamples, StayWithinTheirBounds) {
  MclConfig config;
  config.minSamples = 500;
  config.maxSamples = 2000;
  for (const std::size_t bins : {0u, 1u, 2u}) EXPECT_EQ(kldSamples(config, bins), 500u);
  EXPECT_EQ(kldSamples(config, 1000000), 2000u);
}

TEST(PoseBins, CountsWhatATreeOfBinsCounts) {
  MclConfig config;
  config.binMetres = 0.5;
  config.binRadians = kPi / 6;
  Random random(1);
  Poses poses;
  std::set<std::array<long, 3>> expected;
  for (int i = 0; i < 20000; ++i) {
    poses.add(random.uniform(-4, 4), random.uniform(-3, 3), random.uniform(-kPi, kPi));
    const auto bin = [](float v, double size) {
      return std::lround(std::floor(static_cast<double>(v) / size));
    };
    expected.insert({bin(poses.x.back(), 0.5), bin(poses.y.back(), 0.5),
                     (bin(poses.theta.back(), kPi / 6) + 12) % 12});
  }
  const PoseBins bins(config, poses.view());
  EXPECT_EQ(bins.count(), expected.size());
  std::set<std::uint32_t> numbers;
  for (std::size_t i = 0; i < poses.x.size(); ++i) numbers.insert(bins.binOf(i));
  EXPECT_EQ(numbers.size(), expected.size());
}

TEST(PoseBins, AreTheSameWithAnyThreads) {
  const MclConfig config;
  Random random(3);
  Poses poses;
  for (int i = 0; i < 30000; ++i)
    poses.add(random.gaussian(), random.gaussian(), 0.5 * random.gaussian());
  std::vector<std::uint32_t> drawn;
  for (std::uint32_t i = 100; i < 20000; i += 1 + i % 3) drawn.push_back(i);
  const PoseBins alone(config, poses.view());
  Workers workers(3);
  const PoseBins shared(config, poses.view(), &workers);
  ASSERT_GT(alone.count(), 500U);
  EXPECT_EQ(shared.count(), alone.count());
  std::set<std::uint32_t> ofDrawn;
  std::uint32_t most = 0;
  for (std::uint32_t i = 0; i < 30000; ++i) {
    ASSERT_EQ(shared.binOf(i), alone.binOf(i));
    ASSERT_LE(alone.binOf(i), most) << "they are numbered as they occur";
    most = std::max(most, alone.binOf(i) + 1);
  }
  for (const std::uint32_t i : drawn) ofDrawn.insert(alone.binOf(i));
  EXPECT_EQ(alone.countOf(drawn), ofDrawn.size());
  EXPECT_EQ(shared.countOf(drawn, &workers), ofDrawn.size());
  EXPECT_EQ(shared.clusters(), alone.clusters());
}

TEST(PoseBins, DoNotCareForWholeTurns) {
  Poses poses;
  for (int turn = -3; turn <= 3; ++turn) poses.add(0.1, 0.1, 1.0 + turn * 2 * kPi);
  EXPECT_EQ(PoseBins(MclConfig(), poses.view()).count(), 1u);
}

TEST(PoseBins, OfAWholeTurnDoNotCareForHeadings) {
  MclConfig config;
  config.binRadians = 2 * kPi;
  Poses poses;
  for (int i = 0; i < 100; ++i) poses.add(0.1, 0.1, -kPi + 0.0628 * i);
  EXPECT_EQ(PoseBins(config, poses.view()).count(), 1u);
  config.binRadians = kPi;
  EXPECT_EQ(PoseBins(config, poses.view()).count(), 2u);
}

TEST(PoseBins, SurvivesAnyNumber) {
  Poses poses;
  for (const double v :
       {0.0, 1e30, -1e30, static_cast<double>(NAN), static_cast<double>(INFINITY)}) {
    poses.add(v, 0, 0);
    poses.add(0, v, 0);
    poses.add(0, 0, v);
  }
  const PoseBins bins(MclConfig(), poses.view());
  EXPECT_GE(bins.count(), 1u);
  EXPECT_EQ(bins.clusters().size(), bins.count());
}

std::size_t clustersOf(const Poses& poses) {
  const auto clusters = PoseBins(MclConfig(), poses.view()).clusters();
  return std::set<std::uint32_t>(clusters.begin(), clusters.end()).size();
}

TEST(PoseBins, BinsThatTouchHangTogether) {
  const double b = MclConfig().binMetres;
  const double t = 2 * kPi / 36;  // the default is a turn's 36th part
  const auto two = [&](double dx, double dy, double dtheta) {
    Poses poses;
    poses.add(0.5 * b, 0.5 * b, 0.5 * t);
    poses.add((0.5 + dx) * b, (0.5 + dy) * b, (0.5 + dtheta) * t);
    return clustersOf(poses);
  };
  for (int dx = -2; dx <= 2; ++dx) {
    for (int dy = -2; dy <= 2; ++dy) {
      for (int dt = -2; dt <= 2; ++dt) {
        const bool touch = std::abs(dx) <= 1 && std::abs(dy) <= 1 && std::abs(dt) <= 1;
        EXPECT_EQ(two(dx, dy, dt), touch ? 1u : 2u) << dx << " " << dy << " " << dt;
      }
    }
  }
}

TEST(PoseBins, ClustersReachAcrossTheSeamOfHeadings) {
  Poses poses;
  poses.add(0.1, 0.1, kPi - 0.01);
  poses.add(0.1, 0.1, -kPi + 0.01);
  EXPECT_EQ(clustersOf(poses), 1u);
}

TEST(PoseBins, AChainIsOneCluster) {
  Poses poses;
  for (int i = 199; i >= 0; --i) poses.add(0.2 * i, 0.1 * (i % 3), 0.1 * i);
  EXPECT_EQ(clustersOf(poses), 1u);
}

TEST(Estimate, IsTheHeavierClusterWithItsMoments) {
  Poses poses;
  // A square of side 0.2 around (1, 1) with heading 0.5 +- 0.1; another cluster far off.
  std::vector<double> weights;
  for (const double dx : {-0.1, 0.1}) {
    for (const double dy : {-0.1, 0.1}) {
      poses.add(1.1 + dx, 1.1 + dy, 0.5 + dx);
      weights.push_back(0.15);
    }
  }
  poses.add(-3, -3, 0);
  weights.push_back(0.4);
  const PoseEstimate e = estimateOf(MclConfig(), poses.view(), weights);
  EXPECT_EQ(e.samples, 5u);
  EXPECT_NEAR(e.share, 0.6, 1e-12);
  EXPECT_NEAR(e.pose.x, 1.1, 1e-6);
  EXPECT_NEAR(e.pose.y, 1.1, 1e-6);
  EXPECT_NEAR(e.pose.theta, 0.5, 1e-6);
  const PoseCovariance expected = {0.01, 0, 0.01, 0, 0.01, 0, 0.01, 0, 0.01};
  for (std::size_t i = 0; i < 9; ++i) EXPECT_NEAR(e.covariance[i], expected[i], 1e-6) << i;
}

TEST(Estimate, TheMeanHeadingOfASetAroundPiIsPi) {
  Poses poses;
  std::vector<double> weights;
  for (int i = -10; i <= 10; ++i) {
    poses.add(0, 0, kPi + 0.01 * i + (i % 2) * 2 * kPi);
    weights.push_back(1.0 / 21);
  }
  const PoseEstimate e = estimateOf(MclConfig(), poses.view(), weights);
  EXPECT_NEAR(std::abs(e.pose.theta), kPi, 1e-6);
  EXPECT_NEAR(e.share, 1.0, 1e-12);
  // The variance of 21 even steps of 0.01: 0.01^2 (21^2 - 1) / 12.
  EXPECT_NEAR(e.covariance[8], 1e-4 * 440 / 12, 1e-7);
}

TEST(Clusters, AreToldHeaviestFirstWithTheirShares) {
  SampleSet set;
  set.resize(60);
  std::vector<double> weights(60, 1.0 / 60.0);
  for (std::size_t i = 0; i < 60; ++i) {
    // 10 samples around (0, 0), 20 around (5, 0), 30 around (0, 5), in turn.
    const std::size_t place = i % 6 == 0 ? 0 : i % 6 < 3 ? 1 : 2;
    set.x[i] = (place == 1 ? 5.0F : 0.0F) + (i % 2 == 0 ? 0.01F : -0.01F);
    set.y[i] = place == 2 ? 5.0F : 0.0F;
    set.theta[i] = 1.0F;
  }
  const auto clusters = clustersOf(PoseBins(MclConfig{}, set.view()), set.view(), weights, 0.2);
  ASSERT_EQ(clusters.size(), 2u) << "the third has a sixth";
  EXPECT_NEAR(clusters[0].share, 0.5, 1e-9);
  EXPECT_NEAR(clusters[0].pose.y, 5.0, 1e-6);
  EXPECT_NEAR(clusters[1].share, 1.0 / 3.0, 1e-9);
  EXPECT_NEAR(clusters[1].pose.x, 5.0, 0.011);
  EXPECT_LT(clusters[1].covariance[0], 1.1e-4);
  EXPECT_EQ(clustersOf(PoseBins(MclConfig{}, set.view()), set.view(), weights, 0.1).size(), 3u);
  EXPECT_EQ(clustersOf(PoseBins(MclConfig{}, set.view()), set.view(), weights, 2.0).size(), 1u);
  EXPECT_NEAR(estimateOf(MclConfig{}, set.view(), weights).share, 0.5, 1e-9);
}

}  // namespace
}  // namespace ortung

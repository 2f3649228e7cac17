#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "Recovery.hpp"

namespace ortung {
namespace {

double shareAfter(Recovery& recovery, double fit, int times) {
  for (int i = 0; i < times; ++i) recovery.follow(fit);
  return recovery.injectedShare();
}

TEST(Recovery, DrawsNothingWhileReadingsFitAsEver) {
  Recovery recovery{MclConfig{}};
  EXPECT_EQ(recovery.injectedShare(), 0.0) << "nothing is known yet";
  EXPECT_EQ(shareAfter(recovery, 0.9, 1), 0.0);
  EXPECT_EQ(shareAfter(recovery, 0.9, 500), 0.0);
  EXPECT_EQ(shareAfter(recovery, 0.6, 1), 0.0);
  EXPECT_EQ(shareAfter(recovery, 1.0, 100), 0.0);
}

// From 0.9 to 0.3 at once: averages are 0.3 + 0.6 (1 - rate)^n, and what is missing to 0.6 of the
// long one is drawn. The fit is not poor in itself: 0.3 is above 0.25.
TEST(Recovery, DrawsAsTheFitFallsBehindItsOwnPast) {
  MclConfig config;
  config.injectMost = 0.9;
  for (const double fast : {0.2, 0.5}) {
    config.injectFast = fast;
    Recovery recovery(config);
    shareAfter(recovery, 0.9, 50);
    double greatest = 0.0;
    for (int n = 1; n <= 60; ++n) {
      const double shortTerm = 0.3 + 0.6 * std::pow(1 - fast, n);
      const double longTerm = 0.3 + 0.6 * std::pow(1 - 0.01, n);
      const double expected = std::max(0.0, 0.6 - shortTerm / longTerm);
      EXPECT_NEAR(shareAfter(recovery, 0.3, 1), expected, 1e-9) << n;
      greatest = std::max(greatest, expected);
    }
    EXPECT_GT(greatest, 0.15);
  }
}

TEST(Recovery, DrawsWhereTheFitWasAlwaysPoor) {
  MclConfig config;
  config.injectMost = 0.9;
  Recovery poor(config);
  EXPECT_NEAR(shareAfter(poor, 0.1, 30), 1.0 - 0.1 / 0.25, 1e-9);
  Recovery nearly(config);
  EXPECT_NEAR(shareAfter(nearly, 0.24, 30), 0.04, 1e-9);
  Recovery fine(config);
  EXPECT_EQ(shareAfter(fine, 0.26, 30), 0.0);
}

TEST(Recovery, KeepsToItsSettings) {
  MclConfig config;
  config.injectMost = 0.07;
  Recovery bounded(config);
  EXPECT_EQ(shareAfter(bounded, 0.0, 30), 0.07);
  config.injectSlow = 0.0;
  Recovery never(config);
  EXPECT_EQ(shareAfter(never, 0.0, 30), 0.0);
  // The faster the long average, the sooner a worse world is taken for the usual one.
  MclConfig forgetful;
  forgetful.injectSlow = 0.2;
  Recovery used(forgetful);
  shareAfter(used, 0.9, 50);
  EXPECT_EQ(shareAfter(used, 0.3, 10), 0.0);
}

TEST(Recovery, ForgetsThePastWhenItBeginsAnew) {
  Recovery recovery{MclConfig{}};
  shareAfter(recovery, 0.9, 50);
  ASSERT_GT(shareAfter(recovery, 0.3, 10), 0.0);
  recovery.forget();
  EXPECT_EQ(recovery.injectedShare(), 0.0);
  EXPECT_EQ(shareAfter(recovery, 0.3, 10), 0.0) << "as good as it ever was";
}

/// Answers by x; nowhere is -8.
struct Answering : Weigher {
  explicit Answering(std::function<float(float)> a) : answer(std::move(a)) {}
  void weigh(const SampleView& poses, std::span<float> logProbability) const override {
    for (std::size_t i = 0; i < poses.size(); ++i)
      logProbability[i] += std::isnan(poses.x[i]) ? -8.0F : answer(poses.x[i]);
  }
  std::function<float(float)> answer;
};

/// 100 samples at x = 0 ... 99, by weights of their own.
struct Belief {
  explicit Belief(const std::function<double(std::size_t)>& weightOf) {
    samples.resize(100);
    double sum = 0.0;
    for (std::size_t i = 0; i < 100; ++i) {
      samples.x[i] = static_cast<float>(i);
      weights.push_back(weightOf(i));
      sum += weights.back();
    }
    for (double& w : weights) w /= sum;
  }
  std::optional<double> fit(const std::vector<const Weigher*>& readings) const {
    return fitOf(readings, samples, weights);
  }
  SampleSet samples;
  std::vector<double> weights;
};

TEST(Fit, IsOneForAPerfectMatchAndZeroForNoneBetterThanNowhere) {
  const Belief even([](std::size_t) { return 1.0; });
  const Answering perfect([](float) { return 0.0F; });
  const Answering nothing([](float) { return -8.0F; });
  const Answering worse([](float) { return -80.0F; });
  const Answering halfWay([](float) { return -4.0F; });
  EXPECT_NEAR(*even.fit({&perfect}), 1.0, 1e-6);
  EXPECT_NEAR(*even.fit({&nothing}), 0.0, 1e-6);
  EXPECT_EQ(*even.fit({&worse}), 0.0);
  EXPECT_NEAR(*even.fit({&halfWay}), 0.5, 1e-6);
}

TEST(Fit, IsThatOfTheBeliefNotOfAllSamples) {
  const Belief left([](std::size_t i) { return i < 10 ? 1.0 : 0.0; });
  const Answering fitsLeft([](float x) { return x < 10 ? 0.0F : -8.0F; });
  EXPECT_NEAR(*left.fit({&fitsLeft}), 1.0, 1e-6);
  const Belief even([](std::size_t) { return 1.0; });
  EXPECT_NEAR(*even.fit({&fitsLeft}), 0.1, 0.02);
}

TEST(Fit, GivesEveryReadingOneVoiceAndNoneToThoseThatTellNothing) {
  const Belief even([](std::size_t) { return 1.0; });
  const Answering perfect([](float) { return 0.0F; });
  const Answering nothing([](float) { return -8.0F; });
  const Answering nonsense([](float) { return std::nanf(""); });
  EXPECT_NEAR(*even.fit({&perfect, &nothing}), 0.5, 1e-6);
  EXPECT_NEAR(*even.fit({&perfect, &perfect, &nothing}), 2.0 / 3.0, 1e-6);
  EXPECT_NEAR(*even.fit({&perfect, &nonsense}), 0.5, 1e-6) << "nonsense fits nothing";
  struct Indifferent : Weigher {
    void weigh(const SampleView&, std::span<float>) const override {}
  } const indifferent;
  EXPECT_EQ(*even.fit({&perfect, &indifferent}), *even.fit({&perfect}));
  EXPECT_FALSE(even.fit({&indifferent}));
  EXPECT_FALSE(even.fit({}));
}

}  // namespace
}  // namespace ortung

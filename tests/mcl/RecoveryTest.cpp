#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <utility>
#include <vector>

#include "Recovery.hpp"

namespace ortung {
namespace {

Recovery after(const MclConfig& config, const std::vector<std::pair<double, int>>& fits) {
  Recovery recovery(config);
  for (const auto& [fit, times] : fits)
    for (int i = 0; i < times; ++i) recovery.follow(fit, false);
  return recovery;
}

TEST(Recovery, IsContentWhileReadingsFitAsEver) {
  for (const auto& fits : std::vector<std::vector<std::pair<double, int>>>{
           {}, {{0.9, 1}}, {{0.9, 500}}, {{0.6, 1}}, {{0.3, 500}}, {{0.6, 500}, {1.0, 100}}}) {
    const Recovery recovery = after({}, fits);
    EXPECT_FALSE(recovery.isDoubtful());
    EXPECT_FALSE(recovery.callsForSearch());
    EXPECT_EQ(recovery.hasRecovered(), !fits.empty());
  }
}

TEST(Recovery, IsNoneWhereTheFitWasAlwaysPoor) {
  EXPECT_TRUE(after({}, {{0.26, 500}}).hasRecovered());
  EXPECT_FALSE(after({}, {{0.24, 500}}).hasRecovered());
}

TEST(Recovery, TwoUnusualReadingsOnEndCallForASearch) {
  Recovery recovery = after({}, {{0.9, 100}});
  for (int i = 0; i < 100; ++i) recovery.followBest(0.9);
  recovery.followBest(0.7);
  EXPECT_FALSE(recovery.callsForSearch());
  recovery.followBest(0.9);
  recovery.followBest(0.7);
  EXPECT_FALSE(recovery.callsForSearch()) << "not on end";
  recovery.followBest(0.7);
  EXPECT_TRUE(recovery.callsForSearch());
}

// Below 0.75 of what is usual the moment is doubtful; the short average, 0.3 + 0.6 (1 - rate)^n,
// has to fall below 0.6 of it (0.54) for a search: rate 0.2 after five readings, 0.5 after two.
TEST(Recovery, DoubtsAtOnceAndSearchesLater) {
  EXPECT_FALSE(after({}, {{0.9, 50}, {0.7, 1}}).isDoubtful());
  EXPECT_TRUE(after({}, {{0.9, 50}, {0.65, 1}}).isDoubtful());
  EXPECT_FALSE(after({}, {{0.9, 50}, {0.65, 1}, {0.9, 1}}).isDoubtful());
  for (const auto& [rate, readings] : {std::pair{0.2, 5}, {0.5, 2}}) {
    MclConfig config;
    config.recoverFast = rate;
    EXPECT_FALSE(after(config, {{0.9, 50}, {0.3, readings - 1}}).callsForSearch()) << rate;
    EXPECT_TRUE(after(config, {{0.9, 50}, {0.3, readings}}).callsForSearch()) << rate;
  }
}

// Without odometry what is expected is poor wherever the robot is: readings that fit somewhere in
// the belief raise no doubt, and the first one that does not raises it.
TEST(Recovery, JudgesABlindBeliefByWhatIsLeftOnceItIsWeighed) {
  Recovery recovery{MclConfig{}};
  for (int i = 0; i < 50; ++i) {
    recovery.follow(0.9);
    recovery.followBest(0.9);
  }
  for (int i = 0; i < 50; ++i) {
    recovery.followBlindly();
    recovery.followBest(0.88);
    EXPECT_FALSE(recovery.isDoubtful());
    EXPECT_FALSE(recovery.callsForSearch());
  }
  EXPECT_TRUE(recovery.hasRecovered());
  recovery.followBlindly();
  recovery.followBest(0.4);
  EXPECT_TRUE(recovery.isDoubtful());
  EXPECT_TRUE(recovery.callsForSearch());
  EXPECT_FALSE(recovery.hasRecovered());
}

// A robot that stands among people for long has seen them once.
TEST(Recovery, WhatIsUsualFallsWithTheDistanceAlone) {
  const auto isUsualAfter = [](double part) {
    Recovery recovery{MclConfig{}};
    for (int i = 0; i < 300; ++i) recovery.followBest(0.9);
    for (int i = 0; i < 1000; ++i) recovery.followBest(0.6, part);
    return recovery.isUsual(0.65);
  };
  EXPECT_TRUE(isUsualAfter(1.0));
  EXPECT_FALSE(isUsualAfter(0.1));
  EXPECT_FALSE(isUsualAfter(0.0));
}

// Where odometry never leads to the readings, what is expected is always poor; what is left after
// they are weighed tells.
TEST(Recovery, DoubtsOdometryThatStandsWhenTwoReadingsFitNowhereInTheBelief) {
  const auto isDoubtfulAfter = [](int unusual, bool stands) {
    const MclConfig config;
    Recovery recovery(config);
    for (int i = 0; i < 50; ++i) {
      recovery.follow(0.4, stands);
      recovery.followBest(0.9);
    }
    EXPECT_FALSE(recovery.isDoubtful());
    for (int i = 0; i < unusual; ++i) {
      recovery.follow(0.4, stands);
      recovery.followBest(0.5);
    }
    return recovery.isDoubtful();
  };
  EXPECT_FALSE(isDoubtfulAfter(1, true)) << "one may be a chance";
  EXPECT_TRUE(isDoubtfulAfter(2, true));
  EXPECT_FALSE(isDoubtfulAfter(2, false));
}

TEST(Recovery, SearchesWhereTheFitWasAlwaysPoor) {
  EXPECT_TRUE(after({}, {{0.24, 30}}).callsForSearch());
  EXPECT_TRUE(after({}, {{0.24, 30}}).isDoubtful());
  EXPECT_FALSE(after({}, {{0.26, 30}}).callsForSearch());
}

TEST(Recovery, IsOverWhenTheFitIsWhatItWas) {
  EXPECT_FALSE(after({}, {{0.9, 50}, {0.3, 10}}).hasRecovered());
  EXPECT_FALSE(after({}, {{0.9, 50}, {0.3, 10}, {0.9, 2}}).hasRecovered());
  EXPECT_TRUE(after({}, {{0.9, 50}, {0.3, 10}, {0.9, 20}}).hasRecovered());
}

TEST(Recovery, KeepsToItsSettings) {
  MclConfig config;
  config.recoverSlow = 0.0;
  EXPECT_FALSE(after(config, {{0.9, 50}, {0.0, 30}}).callsForSearch());
  EXPECT_FALSE(after(config, {{0.9, 50}, {0.0, 30}}).isDoubtful());
  // The faster the long average, the sooner a worse world is taken for the usual one; in bad times
  // it follows at a tenth of that.
  EXPECT_TRUE(after({}, {{0.9, 50}, {0.3, 100}}).callsForSearch());
  config.recoverSlow = 0.5;
  EXPECT_FALSE(after(config, {{0.9, 50}, {0.3, 100}}).callsForSearch());
  config.recoverSlow = 0.1;
  EXPECT_TRUE(after(config, {{0.9, 50}, {0.3, 30}}).callsForSearch()) << "0.9 * 0.99^30 is 0.67";
}

TEST(Recovery, ForgetsThePastWhenItBeginsAnew) {
  Recovery recovery = after({}, {{0.9, 50}, {0.3, 10}});
  ASSERT_TRUE(recovery.callsForSearch());
  recovery.beginAnew();
  EXPECT_FALSE(recovery.callsForSearch());
  for (int i = 0; i < 10; ++i) recovery.follow(0.3, false);
  EXPECT_FALSE(recovery.callsForSearch()) << "as good as it ever was";
}

// As good as 0.85 of the long-term average of best fits, and better than nothing.
TEST(Recovery, UsualIsWhatReadingsUseToFitWhereTheyFitBest) {
  Recovery recovery{MclConfig{}};
  EXPECT_FALSE(recovery.isUsual(0.84)) << "as long as nothing is known: nearly perfect";
  EXPECT_TRUE(recovery.isUsual(0.86));
  recovery.followBest(0.6);
  EXPECT_FALSE(recovery.isUsual(0.50));
  EXPECT_TRUE(recovery.isUsual(0.52));
  Recovery poor{MclConfig{}};
  poor.followBest(0.2);
  EXPECT_FALSE(poor.isUsual(0.24));
  EXPECT_TRUE(poor.isUsual(0.26));
}

// The average goes to 0.6 + 0.3 * (1 - rate)^100: rate 0.01, or a tenth of it in bad times.
// It rises with 0.01 a reading, and falls ten times as slowly, whatever the fit where the robot was
// expected: a crowd that stays with the robot makes the average poor in half a minute, and then any
// place would do that looks a little like it.
// Sightings of single landmarks scatter far more than scans of hundreds of beams.
TEST(Recovery, WhereReadingsScatterAWorseOneIsUsual) {
  Recovery steady({});
  Recovery scattering({});
  for (int i = 0; i < 600; ++i) {
    steady.followBest(0.85);
    scattering.followBest(i % 3 == 0 ? 0.7 : 0.85);
  }
  const auto isUnusual = [](Recovery recovery, double fit) {
    recovery.followBest(fit);
    return recovery.unusual() > 0;
  };
  EXPECT_TRUE(isUnusual(steady, 0.7));
  EXPECT_FALSE(isUnusual(scattering, 0.7));
  EXPECT_FALSE(isUnusual(scattering, 0.69));
  EXPECT_TRUE(isUnusual(scattering, 0.6)) << "three times as far off as usual";
  EXPECT_FALSE(scattering.isUsual(0.7)) << "it is no evidence for another place";
}

// In a crowd that stays, fits are anything but usual, and don't become it.
TEST(Recovery, ACrowdThatStaysIsNotTakenForScatter) {
  Recovery recovery({});
  for (int i = 0; i < 300; ++i) recovery.followBest(0.9);
  for (int i = 0; i < 100; ++i) recovery.followBest(i % 2 == 0 ? 0.3 : 0.5);
  EXPECT_GT(recovery.unusual(), 90);
}

TEST(Recovery, WhatIsUsualRisesSlowlyAndFallsMoreSlowly) {
  Recovery recovery = after({}, {{0.95, 100}});
  for (int i = 0; i < 100; ++i) recovery.followBest(0.95);
  for (int i = 0; i < 120; ++i) {
    recovery.follow(0.35);
    recovery.followBest(0.37);
  }
  const double falls = 0.37 + 0.58 * std::pow(0.999, 120);
  EXPECT_FALSE(recovery.isUsual(0.85 * falls - 0.002));
  EXPECT_TRUE(recovery.isUsual(0.85 * falls + 0.002));
  EXPECT_FALSE(recovery.isUsual(0.75)) << "a wrong place";
  for (int i = 0; i < 50; ++i) recovery.followBest(1.0);
  const double rises = 1.0 - (1.0 - falls) * std::pow(0.99, 50);
  EXPECT_FALSE(recovery.isUsual(0.85 * rises - 0.002));
  EXPECT_TRUE(recovery.isUsual(0.85 * rises + 0.002));
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

TEST(Fit, IsTheSameFromLikelihoodsThatAreKnown) {
  const Belief uneven([](std::size_t i) { return 1.0 + static_cast<double>(i % 7); });
  std::size_t asked = 0;
  const Answering some([&](float x) {
    ++asked;
    return -0.037F * x;
  });
  const Answering nothing([](float) { return -8.0F; });
  std::vector<float> known(uneven.samples.size());
  some.getProbability(uneven.samples.view(), known);
  const auto fitOfKnown = [&](const std::vector<const Weigher*>& readings) {
    return fitOf(readings, uneven.samples, uneven.weights, nullptr, known);
  };
  const auto fit = uneven.fit({&some});
  EXPECT_GT(*fit, 0.1);
  asked = 0;
  EXPECT_EQ(fitOfKnown({&some}), fit);
  EXPECT_EQ(asked, 0U) << "but for what a pose outside of the map is like";
  // What several readings say together is not what each of them says.
  EXPECT_EQ(fitOfKnown({&some, &nothing}), uneven.fit({&some, &nothing}));
  known.pop_back();  // nor do these belong to the samples
  EXPECT_EQ(fitOfKnown({&some}), fit);
}

TEST(FitsAt, IsTheFitOfABeliefInOnePose) {
  const Answering some([](float x) { return -0.37F * x; });
  const Answering nothing([](float) { return -8.0F; });
  const std::vector<const Weigher*> readings = {&some, &nothing};
  const std::vector<Pose2> poses = {{1.5, 0, 0}, {0, 1, 2}, {7.3, 0, 0}};
  const std::vector<double> fits = fitsAt(readings, poses);
  ASSERT_EQ(fits.size(), poses.size());
  for (std::size_t i = 0; i < poses.size(); ++i) {
    SampleSet one;
    one.resize(1);
    one.x[0] = static_cast<float>(poses[i].x);
    one.y[0] = static_cast<float>(poses[i].y);
    one.theta[0] = static_cast<float>(poses[i].theta);
    EXPECT_EQ(fits[i], *fitOf(readings, one, std::vector{1.0})) << i;
  }
  EXPECT_EQ(fitsAt({}, poses), std::vector<double>(poses.size(), 0.0));
}

}  // namespace
}  // namespace ortung

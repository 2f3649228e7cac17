// One account of where the robot is: what readings make of it, and what it takes to lead.
#include <gtest/gtest.h>

#include <cmath>

#include "Hypothesis.hpp"

namespace ortung {
namespace {

SampleSet at(const std::vector<float>& x) {
  SampleSet set;
  set.resize(x.size());
  set.x = x;
  return set;
}

/// A reading that fits where x is @p x, as well as @p sigma says.
Evidence readingAt(double x, double sigma) {
  Evidence evidence;
  evidence.weigh = [x, sigma](const SampleSet& set, std::vector<float>& out) {
    out.clear();
    for (const float its : set.x) {
      const double off = (static_cast<double>(its) - x) / sigma;
      out.push_back(static_cast<float>(-0.5 * off * off));
    }
  };
  return evidence;
}

Hypothesis::Climb noClimb() {
  ADD_FAILURE() << "nobody needs to climb";
  return {1, 1, Random(1), Random(1)};
}

// p of the reading is e^0, e^-0.5 and e^-2, and the third sample weighs twice as much before.
TEST(Hypothesis, IsWeighedByBayesRule) {
  SampleSet set = at({0, 1, 2});
  set.logWeight[2] = std::log(2.0F);
  Hypothesis hypothesis(std::move(set));
  const Hypothesis::Said said = hypothesis.weigh(readingAt(0, 1), MclConfig{}, 0.0, noClimb);
  const double p[] = {1.0, std::exp(-0.5), 2.0 * std::exp(-2.0)};
  const double sum = p[0] + p[1] + p[2];
  EXPECT_NEAR(said.logEvidence, std::log(sum / 4.0), 1e-6);
  EXPECT_NEAR(said.logEvidenceOf(0, 2), std::log((p[0] + p[1]) / 2.0), 1e-6);
  const std::vector<double> weights = hypothesis.weights();
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(weights[i], p[i] / sum, 1e-6) << i;
}

// The mean of a normal distribution that a sharper one is multiplied with is nearly the sharper
// one's: none of the samples is there, and those that are left climb there.
TEST(Hypothesis, ClimbsToWhereASharpReadingIs) {
  Random random(3);
  SampleSet set;
  set.resize(200);
  for (float& x : set.x) x = static_cast<float>(0.1 * random.gaussian());
  for (float& y : set.y) y = static_cast<float>(0.1 * random.gaussian());
  Hypothesis hypothesis(std::move(set));
  int climbs = 0;
  const auto climb = [&] {
    ++climbs;
    return Hypothesis::Climb{200, 150, Random(4), Random(5)};
  };
  hypothesis.weigh(readingAt(0.25, 0.002), MclConfig{}, 25.0, climb);
  EXPECT_EQ(climbs, 1);
  ASSERT_EQ(hypothesis.samples().size(), 150U);
  const std::vector<double> weights = hypothesis.weights();
  double mean = 0.0;
  for (std::size_t i = 0; i < weights.size(); ++i)
    mean += weights[i] * static_cast<double>(hypothesis.samples().x[i]);
  EXPECT_NEAR(mean, 0.25, 0.002) << "its sigma, of many samples";
}

TEST(Hypothesis, IsSpokenForOnlyByReadingsThatFitAsUsual) {
  Hypothesis hypothesis(at({0}));
  EXPECT_FALSE(hypothesis.count(3.0, 1.0, false));
  EXPECT_FALSE(hypothesis.count(3.0, 1.0, false));
  EXPECT_EQ(hypothesis.lead().nats(), 0.0);
  EXPECT_EQ(hypothesis.unusual(), 2);
  EXPECT_TRUE(hypothesis.count(3.0, 0.5, true));
  EXPECT_EQ(hypothesis.lead().nats(), 1.5);
  EXPECT_EQ(hypothesis.unusual(), 0);
  EXPECT_TRUE(hypothesis.count(-1.0, 1.0, false)) << "against it all of them speak";
  EXPECT_EQ(hypothesis.lead().nats(), 0.5);
}

TEST(Hypothesis, MovesEachSampleOnceWithANoiseOfItsOwn) {
  Hypothesis hypothesis(at(std::vector<float>(5000)));
  hypothesis.move(1000, [](const MovableSamples& some, std::size_t first) {
    for (std::size_t i = 0; i < some.x.size(); ++i) some.x[i] += static_cast<float>(first + i);
  });
  for (std::size_t i = 0; i < 5000; ++i)
    ASSERT_EQ(hypothesis.samples().x[i], static_cast<float>(1000 + i));
}

TEST(Hypothesis, ScalesWeightsSoThatTheLargestIsOne) {
  SampleSet set = at({0, 1});
  set.logWeight = {-1000.0F, -1002.0F};
  Hypothesis hypothesis(std::move(set));
  hypothesis.scaleWeights();
  EXPECT_EQ(hypothesis.samples().logWeight, (std::vector<float>{0.0F, -2.0F}));
}

}  // namespace
}  // namespace ortung

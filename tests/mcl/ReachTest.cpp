// How far a belief reaches from a pose, against sorted distances.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "Reach.hpp"
#include "ortung/base/Angles.hpp"
#include "ortung/base/Random.hpp"

namespace ortung {
namespace {

/// Samples at the origin, and a share of them elsewhere.
SampleSet twoPlaces(std::size_t here, std::size_t there, const Pose2& place) {
  SampleSet samples;
  samples.resize(here + there);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    samples.x[i] = i < here ? 0.0F : static_cast<float>(place.x);
    samples.y[i] = i < here ? 0.0F : static_cast<float>(place.y);
    samples.theta[i] = i < here ? 0.0F : static_cast<float>(place.theta);
  }
  return samples;
}

TEST(Reach, GoesToAnotherPlaceIfItsShareIsNotTheRest) {
  const SampleSet samples = twoPlaces(98, 2, {3.0, 4.0, 3.0});
  const std::vector<double> weights(100, 0.01);
  EXPECT_NEAR(reachOf(samples.view(), weights, {}, 0.015).metres, 5.0, 1e-6);
  EXPECT_NEAR(reachOf(samples.view(), weights, {}, 0.015).radians, 3.0, 1e-6);
  EXPECT_EQ(reachOf(samples.view(), weights, {}, 0.025).metres, 0.0);
  EXPECT_EQ(reachOf(samples.view(), weights, {}, 0.025).radians, 0.0);
}

TEST(Reach, HeadingsTurnTheShorterWay) {
  const SampleSet samples = twoPlaces(1, 1, {0.0, 0.0, -3.0});
  const std::vector<double> weights(2, 0.5);
  EXPECT_NEAR(reachOf(samples.view(), weights, {0.0, 0.0, 3.0}, 0.1).radians, 3.0, 1e-6);
  EXPECT_NEAR(reachOf(samples.view(), weights, {0.0, 0.0, 3.0}, 0.6).radians,
              2.0 * std::numbers::pi - 6.0, 1e-6);
}

// Of samples that are drawn and weighed at random, the share beyond the reach is at most the rest,
// and would be more with the sample at the reach.
TEST(Reach, LeavesNoMoreThanTheRestBeyondIt) {
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    Random random(seed);
    SampleSet samples;
    samples.resize(100 + 20 * seed);
    std::vector<double> weights(samples.size());
    double sum = 0.0;
    for (std::size_t i = 0; i < samples.size(); ++i) {
      samples.x[i] = static_cast<float>(random.gaussian());
      samples.y[i] = static_cast<float>(random.gaussian());
      samples.theta[i] = static_cast<float>(wrapAngle(random.gaussian()));
      sum += weights[i] = i % 7 == 0 ? 0.0 : random.uniform();
    }
    for (double& w : weights) w /= sum;
    const Pose2 pose{random.gaussian(), random.gaussian(), random.gaussian()};
    const double rest = 0.001 + 0.2 * random.uniform();
    const PoseDistance reach = reachOf(samples.view(), weights, pose, rest);
    double beyond = 0.0;
    double from = 0.0;
    double beyondAngle = 0.0;
    double fromAngle = 0.0;
    for (std::size_t i = 0; i < samples.size(); ++i) {
      const double metres = std::hypot(samples.x[i] - pose.x, samples.y[i] - pose.y);
      const double radians = std::abs(wrapAngle(samples.theta[i] - pose.theta));
      if (metres > reach.metres + 1e-9) beyond += weights[i];
      if (metres > reach.metres - 1e-9) from += weights[i];
      if (radians > reach.radians + 1e-9) beyondAngle += weights[i];
      if (radians > reach.radians - 1e-9) fromAngle += weights[i];
    }
    EXPECT_LE(beyond, rest) << seed;
    EXPECT_GT(from, rest) << seed;
    EXPECT_LE(beyondAngle, rest) << seed;
    EXPECT_GT(fromAngle, rest) << seed;
  }
}

}  // namespace
}  // namespace ortung

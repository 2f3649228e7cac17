#include <gtest/gtest.h>

#include <cmath>

#include "FakeRoom.hpp"
#include "Files.hpp"
#include "ortung/formats/PoseFixData.hpp"

namespace ortung {
namespace {

using test::messageOf;
using Words = std::vector<std::uint32_t>;

const SensorId kId{"M1", "T", "F"};

PoseFixData::Config config() {
  return {.addedSigma = 0.03, .addedHeadingSigma = 0.02, .model = {.outliers = 0.1}};
}

/// Sigmas 0.04 m, 0.2 m and 0.05 rad; correlation of x and y 0.5.
PoseFixData::Fix fixAt(const Pose2& pose) {
  const double xy = 0.5 * 0.04 * 0.2;
  return {pose, {0.04 * 0.04, xy, 0, xy, 0.2 * 0.2, 0, 0, 0, 0.05 * 0.05}};
}

struct Learned {
  explicit Learned(const std::vector<PoseFixData::Fix>& fixes) : data(kId, config()) {
    data.beginLearning(region, test::kPi / 90);
    data.endLearning();  // there is nothing to learn
    data.setData(1, PoseFixData::encode(fixes));
  }
  const FieldRegion region = test::Room{8, 5}.region(0.1, 0.2);
  PoseFixData data;
};

TEST(PoseFixData, KeepsPoseAndCovariance) {
  PoseFixData data(kId, config());
  const PoseFixData::Fix fix = fixAt({1.25, -2.5, 0.75});
  data.setData(1, PoseFixData::encode(std::vector{fix}));
  ASSERT_EQ(data.reading().size(), 1u);
  EXPECT_NEAR(data.reading()[0].pose.x, 1.25, 0.0005001);
  EXPECT_NEAR(data.reading()[0].pose.theta, 0.75, 1e-4);
  for (std::size_t i = 0; i < 9; ++i)
    EXPECT_NEAR(data.reading()[0].covariance[i], fix.covariance[i], 1e-6) << i;
}

TEST(PoseFixData, WeighsByTheDistanceInStandardDeviations) {
  Learned learned({fixAt({0, 0, 0})});
  EXPECT_NEAR(learned.data.getProbability({0, 0, 0}), 1.0, 1e-6);
  // x alone: with what is added, the covariance of x and y is [a b; b c], and the squared distance
  // of (d, 0) is d^2 c / (a c - b^2).
  const double a = 0.04 * 0.04 + 0.03 * 0.03;
  const double b = 0.004;
  const double c = 0.2 * 0.2 + 0.03 * 0.03;
  const double squared = 0.06 * 0.06 * c / (a * c - b * b);
  EXPECT_NEAR(learned.data.getProbability({0.06, 0, 0}), 0.9 * std::exp(-0.5 * squared) + 0.1,
              0.003);
  const double turn = 0.05 * 0.05 / (0.05 * 0.05 + 0.02 * 0.02);
  EXPECT_NEAR(learned.data.getProbability({0, 0, -0.05}), 0.9 * std::exp(-0.5 * turn) + 0.1, 0.003);
  EXPECT_NEAR(learned.data.getProbability({3, 2, 0}), 0.1, 1e-6);
  EXPECT_EQ(learned.data.getProbability({30, 2, 0}), kNoExpectation);
}

TEST(PoseFixData, OneOfSeveralFixesIsRight) {
  Learned learned({fixAt({1, 1, 0}), fixAt({-1, -1, test::kPi})});
  EXPECT_NEAR(learned.data.getProbability({1, 1, 0}), 1.0, 1e-5);
  EXPECT_NEAR(learned.data.getProbability({-1, -1, -test::kPi}), 1.0, 0.01);
  EXPECT_NEAR(learned.data.getProbability({1, 1, test::kPi}), 0.1, 1e-5);
  learned.data.setData(2, {});
  EXPECT_FALSE(learned.data.canWeigh());
}

TEST(PoseFixData, RefusesHostileWords) {
  PoseFixData data(kId, config());
  const Words good = PoseFixData::encode(std::vector{fixAt({0, 0, 0})});
  const auto refusal = [&](std::size_t place, std::uint32_t word) {
    Words words = good;
    words[place] = word;
    return messageOf<std::invalid_argument>([&] { data.setData(2, words); });
  };
  EXPECT_EQ(messageOf<std::invalid_argument>([&] { data.setData(2, Words(8, 1)); }),
            "M1/T/F: found 8 words, expected nine a pose and at most 64 poses");
  EXPECT_EQ(messageOf<std::invalid_argument>([&] { data.setData(2, Words(9 * 65, 1)); }),
            "M1/T/F: found 585 words, expected nine a pose and at most 64 poses");
  EXPECT_EQ(refusal(2, 36000), "M1/T/F: found the angle word 36000, expected below 36000");
  for (const std::size_t sigma : {3u, 4u, 5u})
    EXPECT_EQ(refusal(sigma, 0), "M1/T/F: found a sigma of 0, expected at least 1");
  for (const std::size_t correlation : {6u, 7u, 8u}) {
    EXPECT_EQ(refusal(correlation, 20001),
              "M1/T/F: found the correlation word 20001, expected at most 20000");
  }
  EXPECT_EQ(data.sequence(), 0u);
}

TEST(PoseFixData, ImpossibleCovariancesStillGiveProbabilities) {
  Learned learned({});
  // Huge and tiny sigmas, correlations of 1 that contradict each other.
  for (const std::uint32_t sigma : {1u, 4294967295u}) {
    const Words words = {2147483648u, 2147483648u, 18000, sigma, sigma, sigma, 20000, 20000, 0};
    learned.data.setData(1, words);
    for (const double x : {0.0, 0.5, 3.0}) {
      const double p = learned.data.getProbability({x, 0.1, 1.0});
      EXPECT_TRUE(p >= 0.0 && p <= 1.0) << p;
    }
  }
}

}  // namespace
}  // namespace ortung

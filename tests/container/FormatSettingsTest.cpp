#include <gtest/gtest.h>

#include <cmath>

#include "AllFormats.hpp"

/// Settings of formats: what each of them does to tables and weights, by the formula.
namespace ortung {
namespace {

using test::batchOfOne;
using test::distanceToPost;
using test::kPi;
using test::kPostX;
using test::kPostY;
using test::learnEverywhere;
using test::modelled;
using Words = std::vector<std::uint32_t>;

const SensorId kId{"M", "T", "F"};
// The model's table has 128 entries a sigma, so its slope is at most 0.61 / sigma; half a level of
// a table of 16 bits is less than that.
constexpr double kTableStep = 0.61 / 128;

class FormatSettings : public ::testing::Test {
 protected:
  const test::Room room_;
  const FieldRegion region_ = room_.region(0.1, 0.2);
  const Pose2 pose_{-2.95, 2.05, 0.0};  ///< on the centre of a cell, 4.9 m from the post
};

/// Both ways to ask, each with the sigma that belongs to the measured range.
TEST_F(FormatSettings, ADistanceIsTheLessSureTheFartherAway) {
  for (const double perMetre : {0.0, 0.1}) {
    ScalarData data(kId, {},
                    {.model = {.sigma = 0.1, .sigmaPerMetre = perMetre, .outliers = 0.05}});
    learnEverywhere(data, region_, 0.1,
                    [](const Pose2& s) { return ScalarData::encode(distanceToPost(s)); });
    const double expected = distanceToPost(pose_);
    const double reading = std::round(1000.0 * (expected + 0.3)) / 1000.0;
    data.setData(1, ScalarData::encode(reading));
    const double p = modelled(reading - expected, 0.1 + perMetre * reading, 0.05);
    EXPECT_NEAR(data.getProbability(pose_), p, kTableStep + 0.01) << perMetre;
    EXPECT_NEAR(std::exp(batchOfOne(data, pose_)), p, kTableStep + 0.01) << perMetre;
  }
}

TEST_F(FormatSettings, ADistanceBeyondTheGreatestIsNotLearned) {
  ScalarData data(kId, {}, {.maxRange = 3.0});
  learnEverywhere(data, region_, 0.1,
                  [](const Pose2& s) { return ScalarData::encode(distanceToPost(s)); });
  data.setData(1, ScalarData::encode(2.0));
  int known = 0;
  for (std::size_t cell = 0; cell < region_.grid.size(); ++cell) {
    const Pose2 pose{region_.grid.centreX(cell), region_.grid.centreY(cell), 0.0};
    if (std::abs(distanceToPost(pose) - 3.0) < 0.002) continue;  // rounding decides
    const bool isKnown = data.getProbability(pose) != kNoExpectation;
    EXPECT_EQ(isKnown, distanceToPost(pose) < 3.0) << pose.x << ", " << pose.y;
    known += isKnown ? 1 : 0;
  }
  EXPECT_GT(known, 100);
}

TEST_F(FormatSettings, RangesOfLandmarksAreTheLessSureTheFartherAway) {
  for (const double perMetre : {0.0, 0.1}) {
    LandmarksData data(
        kId, {},
        {.identities = {7}, .range = {.sigma = 0.1, .sigmaPerMetre = perMetre, .outliers = 0.05}});
    const std::vector<test::Point> post = {{7, kPostX, kPostY}};
    learnEverywhere(data, region_, 0.1,
                    [&](const Pose2& s) { return test::landmarkWords(post, s, 20.0); });
    const double range = std::round(1000.0 * (distanceToPost(pose_) + 0.3)) / 1000.0;
    data.setData(1, LandmarksData::encode(LandmarksData::Reading{
                        {7, range, test::bearingTo(pose_, kPostX, kPostY)}}));
    const double p = modelled(range - distanceToPost(pose_), 0.1 + perMetre * range, 0.05);
    EXPECT_NEAR(data.getProbability(pose_), p, kTableStep + 0.01) << perMetre;
    EXPECT_NEAR(std::exp(batchOfOne(data, pose_)), p, kTableStep + 0.01) << perMetre;
  }
}

TEST_F(FormatSettings, LandmarksBeyondTheGreatestRangeAreNotLearned) {
  LandmarksData data(kId, {}, {.identities = {7}, .maxRange = 3.0, .range = {}});
  const std::vector<test::Point> post = {{7, kPostX, kPostY}};
  learnEverywhere(data, region_, 0.1,
                  [&](const Pose2& s) { return test::landmarkWords(post, s, 20.0); });
  data.setData(1, LandmarksData::encode(LandmarksData::Reading{{7, 2.0, 0.0}}));
  for (std::size_t cell = 0; cell < region_.grid.size(); ++cell) {
    const Pose2 pose{region_.grid.centreX(cell), region_.grid.centreY(cell), 0.0};
    if (std::abs(distanceToPost(pose) - 3.0) < 0.002) continue;
    EXPECT_EQ(data.getProbability(pose) != kNoExpectation, distanceToPost(pose) < 3.0)
        << pose.x << ", " << pose.y;
  }
}

/// A cone in front of the wall at x = 4: ln p is that of the formula for any sigma and exponent.
TEST_F(FormatSettings, ACone) {
  const Pose2 pose{2.05, 0.05, 0.0};
  for (const double perMetre : {0.0, 0.1})
    for (const double exponent : {1.0, 0.3}) {
      ConeData data(
          kId, {},
          {.maxRange = 3.0,
           .resolution = {.metres = 0.001, .perMetre = 0.0},
           .model = {
               .sigma = 0.1, .sigmaPerMetre = perMetre, .outliers = 0.1, .exponent = exponent}});
      learnEverywhere(data, region_, kPi / 36, [&](const Pose2& s) {
        return Words{ConeData::encode(room_.range(s.x, s.y, s.theta), 3.0)};
      });
      const double expected = data.expectation(pose)[0];
      EXPECT_NEAR(expected, 1.95, 0.007);  // levels are 3 m / 254 apart
      data.setData(1, Words{ConeData::encode(2.25, 3.0)});
      const double p = modelled(2.25 - expected, 0.1 + perMetre * 2.25, 0.1, exponent);
      EXPECT_NEAR(data.getProbability(pose), p, 0.01) << perMetre << " " << exponent;
      EXPECT_NEAR(std::exp(batchOfOne(data, pose)), p, 0.01) << perMetre << " " << exponent;
    }
}

/// Beams are 10 degrees apart, directions of the table 2, and neighbouring directions expect what
/// is 1.5 m apart: only those that a beam really points in may be compared with it.
TEST_F(FormatSettings, ABeamSpeaksForItsOwnDirectionAlone) {
  constexpr double kDirection = kPi / 90.0;
  const ScanData::Config config{.beams = 9,
                                .firstAngle = -20.0 * kDirection,
                                .angleStep = 5.0 * kDirection,
                                .maxRange = 8.0,
                                .model = {.sigma = 0.05, .outliers = 0.1, .exponent = 1.0}};
  const auto expected = [&](double angle) {
    return std::lround(wrapAngle(angle) / kDirection) % 2 == 0 ? 2.0F : 3.5F;
  };
  const auto words = [&](const Pose2& s) {
    std::vector<float> ranges;
    for (int i = 0; i < config.beams; ++i)
      ranges.push_back(expected(s.theta + config.firstAngle + i * config.angleStep));
    Words scan;
    ScanData::encode(ranges, config.maxRange, scan);
    return scan;
  };
  ScanData data(kId, {}, config);
  learnEverywhere(data, region_, kDirection, words);
  for (const double heading : {0.0, 6.0 * kDirection, -31.0 * kDirection}) {
    const Pose2 pose{0.05, 0.05, heading};
    data.setData(1, words(pose));
    EXPECT_NEAR(batchOfOne(data, pose), 0.0F, 0.05F) << heading;
  }
}

}  // namespace
}  // namespace ortung

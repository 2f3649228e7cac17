// What features that are tables over the position expect between the centres of cells, and what
// their readings say of a small change of the pose: against closed form.
#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "FakeRoom.hpp"
#include "ortung/core/Correctable.hpp"
#include "ortung/core/Polishable.hpp"
#include "ortung/formats/BearingData.hpp"
#include "ortung/formats/PoseFixData.hpp"
#include "ortung/formats/ScalarData.hpp"

namespace ortung {
namespace {

using test::kPi;

const test::Room kRoom;
const Pose2 kMount{0.1, -0.05, 0.3};
const std::vector<test::Point> kPoints = {{1, -3.7, -2.2}, {2, 3.6, -2.1}, {3, 0.3, 2.3}};

LandmarksData::Config config(double rangeSigma, double bearingSigma) {
  return {
      .identities = {1, 2, 3}, .range = {.sigma = rangeSigma}, .bearing = {.sigma = bearingSigma}};
}

std::unique_ptr<LandmarksData> landmarks(const LandmarksData::Config& c) {
  auto data = std::make_unique<LandmarksData>(SensorId{"M", "T", "F"}, kMount, c);
  test::learnEverywhere(*data, kRoom.region(0.1, 0.2), kPi,
                        [&](const Pose2& s) { return landmarkWords(kPoints, s, c.maxRange); });
  return data;
}

Pose2 somewhere(Random& random) {
  return {random.uniform(-3.5, 3.5), random.uniform(-2.0, 2.0), random.uniform(-kPi, kPi)};
}

std::shared_ptr<const Weigher> perfectAt(SensorData& data, const Pose2& truth) {
  data.setData(1, landmarkWords(kPoints, truth * kMount, 20.0));
  return data.weigher();
}

Eigen::Vector3d newton(const Slope& slope) {
  return Eigen::Map<const Eigen::Matrix3d>(slope.information.data())
      .ldlt()
      .solve(Eigen::Map<const Eigen::Vector3d>(slope.pull.data()));
}

Pose2 moved(const Pose2& pose, const Eigen::Vector3d& by) {
  return {pose.x + by.x(), pose.y + by.y(), wrapAngle(pose.theta + by.z())};
}

/// @param step as wide as the reading's tables need [m] and [rad]
void expectGradient(const Weigher& weigher, const Pose2& pose, double step) {
  const auto* reading = dynamic_cast<const Polishable*>(&weigher);
  ASSERT_NE(reading, nullptr);
  const Slope slope = reading->slopeAt(pose);
  for (int axis = 0; axis < 3; ++axis) {
    const Eigen::Vector3d by = step * Eigen::Vector3d::Unit(axis);
    const double numeric = (std::log(weigher.getProbability(moved(pose, by))) -
                            std::log(weigher.getProbability(moved(pose, -by)))) /
                           (2 * step);
    EXPECT_NEAR(slope.pull[static_cast<std::size_t>(axis)], numeric,
                0.15 + 0.05 * std::abs(numeric))
        << axis;
  }
}

TEST(InterpolatedTables, ExpectAMillimetreAndATenthOfADegreeWhereLandmarksAreNotAtHand) {
  const auto data = landmarks(config(0.1, 0.05));
  Random random(1);
  std::vector<double> ranges;
  std::vector<double> bearings;
  for (int i = 0; i < 2000; ++i) {
    const Pose2 pose = somewhere(random);
    const Pose2 sensor = pose * kMount;
    const std::vector<double> expected = data->expectation(pose);
    for (std::size_t k = 0; k < kPoints.size(); ++k) {
      const double range = std::hypot(kPoints[k].x - sensor.x, kPoints[k].y - sensor.y);
      if (range < 0.5) continue;
      ranges.push_back(std::abs(expected[2 * k] - range));
      bearings.push_back(std::abs(
          wrapAngle(expected[2 * k + 1] - test::bearingTo(sensor, kPoints[k].x, kPoints[k].y))));
    }
  }
  std::sort(ranges.begin(), ranges.end());
  std::sort(bearings.begin(), bearings.end());
  const auto at = [](const std::vector<double>& sorted, double share) {
    return sorted[static_cast<std::size_t>(share * static_cast<double>(sorted.size() - 1))];
  };
  EXPECT_LT(at(ranges, 0.5), 0.0007);
  EXPECT_LT(at(ranges, 0.95), 0.0015);
  EXPECT_LT(at(bearings, 0.5), 0.0002);
  EXPECT_LT(at(bearings, 0.95), 0.0015);
}

TEST(InterpolatedTables, GiveAPerfectReadingAProbabilityOfNearlyOne) {
  const auto data = landmarks(config(0.02, 0.01));
  Random random(2);
  std::vector<double> probabilities;
  for (int i = 0; i < 2000; ++i) {
    const Pose2 pose = somewhere(random);
    probabilities.push_back(perfectAt(*data, pose)->getProbability(pose));
  }
  std::sort(probabilities.begin(), probabilities.end());
  EXPECT_GT(probabilities[1000], 0.99);
  EXPECT_GT(probabilities[100], 0.9);
}

TEST(InterpolatedTables, WeighManySamplesAsTheyWeighOne) {
  const auto data = landmarks(config(0.1, 0.05));
  Random random(3);
  for (int i = 0; i < 500; ++i) {
    const Pose2 truth = somewhere(random);
    const auto weigher = perfectAt(*data, truth);
    // Up to the edges and beyond.
    const Pose2 pose{random.uniform(-4.2, 4.2), random.uniform(-2.7, 2.7), truth.theta};
    const double one = weigher->getProbability(pose);
    if (one == kNoExpectation) continue;
    EXPECT_NEAR(test::batchOfOne(*weigher, pose), std::log(one), 0.02) << pose.x << " " << pose.y;
  }
}

TEST(TableSlope, IsTheGradientOfLnP) {
  const auto data = landmarks(config(0.3, 0.2));
  Random random(4);
  for (int i = 0; i < 50; ++i) {
    const Pose2 truth = somewhere(random);
    const auto weigher = perfectAt(*data, truth);
    if (std::hypot(truth.x + 3.7, truth.y + 2.2) < 1.0 ||
        std::hypot(truth.x - 3.6, truth.y + 2.1) < 1.0 ||
        std::hypot(truth.x - 0.3, truth.y - 2.3) < 1.0)
      continue;
    expectGradient(*weigher, {truth.x + 0.1, truth.y - 0.05, truth.theta + 0.05}, 0.05);
  }
}

TEST(TableSlope, LeadsToThePoseOfAReading) {
  const auto data = landmarks(config(0.1, 0.05));
  Random random(5);
  for (int i = 0; i < 100; ++i) {
    const Pose2 truth = somewhere(random);
    const auto weigher = perfectAt(*data, truth);
    const auto* reading = dynamic_cast<const Polishable*>(weigher.get());
    ASSERT_NE(reading, nullptr);
    const double way = random.uniform(-kPi, kPi);
    Pose2 found{truth.x + 0.1 * std::cos(way), truth.y + 0.1 * std::sin(way), truth.theta + 0.02};
    for (int step = 0; step < 10; ++step) found = moved(found, newton(reading->slopeAt(found)));
    EXPECT_LT(std::hypot(found.x - truth.x, found.y - truth.y), 0.002) << i;
    EXPECT_LT(std::abs(wrapAngle(found.theta - truth.theta)), 0.001) << i;
  }
}

TEST(TableSlope, OfOneDistanceAndOfOneBearingAreThoseOfAListOfOneLandmark) {
  ScalarData distance({"M", "T", "D"}, kMount, {.model = {.sigma = 0.1}});
  BearingData bearing({"M", "T", "B"}, kMount, {.model = {.sigma = 0.05}});
  const auto& point = kPoints[0];
  test::learnEverywhere(distance, kRoom.region(0.1, 0.2), kPi, [&](const Pose2& s) {
    return ScalarData::encode(std::hypot(point.x - s.x, point.y - s.y));
  });
  test::learnEverywhere(bearing, kRoom.region(0.1, 0.2), kPi, [&](const Pose2& s) {
    return BearingData::encode(test::bearingTo(s, point.x, point.y));
  });
  const auto list = landmarks(config(0.1, 0.05));
  const Pose2 pose{1.03, 0.57, 0.4};
  const Pose2 sensor = pose * kMount;
  const double range = std::hypot(point.x - sensor.x, point.y - sensor.y) + 0.05;
  const double angle = test::bearingTo(sensor, point.x, point.y) - 0.02;
  distance.setData(1, ScalarData::encode(range));
  bearing.setData(1, BearingData::encode(angle));
  list->setData(1, LandmarksData::encode({{1, range, angle}}));
  Slope both;
  both.add(dynamic_cast<const Polishable&>(*distance.weigher()).slopeAt(pose), 1.0);
  both.add(dynamic_cast<const Polishable&>(*bearing.weigher()).slopeAt(pose), 1.0);
  const Slope expected = dynamic_cast<const Polishable&>(*list->weigher()).slopeAt(pose);
  for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(both.pull[k], expected.pull[k], 1e-9);
  for (std::size_t k = 0; k < 9; ++k)
    EXPECT_NEAR(both.information[k], expected.information[k], 1e-6);
}

/// What the residuals of a reading, biased as they say, are beside those without.
void expectCorrectable(SensorData& data, const std::vector<std::uint32_t>& read,
                       const std::vector<std::uint32_t>& truth, const DeviceBias& bias,
                       const Pose2& pose) {
  data.setData(1, truth);
  const auto unbiased = data.weigher();
  data.setData(2, read);
  const auto biased = data.weigher();
  const auto* reading = dynamic_cast<const Correctable*>(biased.get());
  ASSERT_NE(reading, nullptr);
  const auto corrected = reading->corrected(bias);
  EXPECT_NEAR(std::log(corrected->getProbability(pose)), std::log(unbiased->getProbability(pose)),
              0.02);
  EXPECT_NEAR(test::batchOfOne(*corrected, pose), test::batchOfOne(*unbiased, pose), 0.02);
  std::vector<ReadingResidual> residuals;
  reading->residualsAt(pose, residuals);
  ASSERT_FALSE(residuals.empty());
  for (const ReadingResidual& r : residuals)
    EXPECT_NEAR(r.value, r.isAngle ? bias.radians : bias.metres + bias.perMetre * r.expected,
                0.005);
}

TEST(Correctable, WeighsAReadingWithoutItsBiasAsOneThatHasNone) {
  const DeviceBias bias{0.2, 0.05, 0.07};
  const auto list = landmarks(config(0.1, 0.05));
  ScalarData distance({"M", "T", "D"}, kMount, {.model = {.sigma = 0.1}});
  BearingData bearing({"M", "T", "B"}, kMount, {.model = {.sigma = 0.05}});
  const auto to = [](const Pose2& sensor) {
    return std::hypot(kPoints[0].x - sensor.x, kPoints[0].y - sensor.y);
  };
  const auto towards = [](const Pose2& sensor) {
    return test::bearingTo(sensor, kPoints[0].x, kPoints[0].y);
  };
  const FieldRegion region = kRoom.region(0.1, 0.2);
  test::learnEverywhere(distance, region, kPi,
                        [&](const Pose2& s) { return ScalarData::encode(to(s)); });
  test::learnEverywhere(bearing, region, kPi,
                        [&](const Pose2& s) { return BearingData::encode(towards(s)); });
  Random random(6);
  for (int i = 0; i < 200; ++i) {
    const Pose2 pose = somewhere(random);
    const Pose2 sensor = pose * kMount;
    if (to(sensor) < 0.8) continue;
    LandmarksData::Reading biased;
    LandmarksData::Reading unbiased;
    for (std::size_t k = 1; k < kPoints.size(); ++k) {
      const double r = std::hypot(kPoints[k].x - sensor.x, kPoints[k].y - sensor.y);
      if (r < 0.8) continue;
      const double b = test::bearingTo(sensor, kPoints[k].x, kPoints[k].y);
      const std::uint32_t identity = kPoints[k].identity;
      unbiased.push_back({identity, r, b});
      biased.push_back({identity, r * (1 + bias.perMetre) + bias.metres, b + bias.radians});
    }
    if (!biased.empty())
      expectCorrectable(*list, LandmarksData::encode(biased), LandmarksData::encode(unbiased), bias,
                        pose);
    const double r = to(sensor);
    expectCorrectable(distance, ScalarData::encode(r * (1 + bias.perMetre) + bias.metres),
                      ScalarData::encode(r), bias, pose);
    expectCorrectable(bearing, BearingData::encode(wrapAngle(towards(sensor) + bias.radians)),
                      BearingData::encode(towards(sensor)), bias, pose);
  }
}

TEST(PoseFixSlope, IsTheGradientOfLnP) {
  PoseFixData data({"M", "T", "F"}, {.addedSigma = 0.05, .addedHeadingSigma = 0.05});
  data.beginLearning(kRoom.region(0.1, 0.2), kPi);
  data.endLearning();
  PoseFixData::Fix fix{{1, 0.5, 3.1}, {}};
  fix.covariance = {0.04, 0.01, 0.002, 0.01, 0.03, -0.004, 0.002, -0.004, 0.02};
  PoseFixData::Fix other = fix;
  other.pose = {-2, 0.5, 1.0};
  const std::vector<PoseFixData::Fix> fixes = {other, fix};
  data.setData(1, PoseFixData::encode(fixes));
  const auto weigher = data.weigher();
  expectGradient(*weigher, {1.1, 0.4, -3.1}, 0.02);
  expectGradient(*weigher, {-2.1, 0.5, 0.9}, 0.02);
}

}  // namespace
}  // namespace ortung

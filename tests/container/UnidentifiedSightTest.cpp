// Sightings of landmarks that nobody tells apart, and what a sensor gets wrong always in the same
// way: against closed form.
#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <vector>

#include "FakeRoom.hpp"
#include "Files.hpp"
#include "ortung/core/BlurrableWeigher.hpp"
#include "ortung/core/Polishable.hpp"

namespace ortung {
namespace {

using test::kPi;

const test::Room kRoom;
const Pose2 kMount{0.1, -0.05, 0.3};
const std::vector<test::Point> kPoints = {{7, -3.7, -2.2}, {8, 3.6, -2.1}, {9, 0.3, 2.3}};

LandmarksData::Config config(const std::vector<test::Point>& points) {
  LandmarksData::Config c{.identities = {},
                          .identified = false,
                          .range = {.sigma = 0.05, .sigmaPerMetre = 0.01, .outliers = 0.1},
                          .bearing = {.sigma = 0.03, .outliers = 0.1},
                          .bias = {}};
  for (const test::Point& point : points) c.identities.push_back(point.identity);
  return c;
}

std::unique_ptr<LandmarksData> learned(const std::vector<test::Point>& points,
                                       const LandmarksData::Config& c) {
  auto data = std::make_unique<LandmarksData>(SensorId{"M", "T", "F"}, kMount, c);
  test::learnEverywhere(*data, kRoom.region(0.1, 0.2), kPi, [&](const Pose2& sensor) {
    return test::landmarkWords(points, sensor, c.maxRange);
  });
  return data;
}

/// Whom they are of is not said.
std::shared_ptr<const Weigher> seenFrom(LandmarksData& data, const std::vector<test::Point>& points,
                                        const Pose2& robot) {
  std::vector<test::Point> unknown = points;
  for (test::Point& point : unknown) point.identity = LandmarksData::kUnknown;
  data.setData(1, test::landmarkWords(unknown, robot * kMount, 20.0));
  return data.weigher();
}

Pose2 somewhere(Random& random) {
  return {random.uniform(-3.0, 3.0), random.uniform(-1.7, 1.7), random.uniform(-kPi, kPi)};
}

/// ln p by the model as it is written down: of each sighting, of the landmark that fits best.
double modelled(const LandmarksData& data, const std::vector<test::Point>& points,
                const Pose2& robot) {
  const Pose2 sensor = robot * kMount;
  const SensorModel& range = data.config().range;
  double sum = 0.0;
  for (const LandmarksData::Sighting& s : data.reading()) {
    double best = 1e9;
    for (const test::Point& point : points) {
      const double off = s.range - std::hypot(point.x - sensor.x, point.y - sensor.y);
      const double aside = wrapAngle(s.bearing - test::bearingTo(sensor, point.x, point.y));
      best = std::min(best, std::hypot(off / (range.sigma + range.sigmaPerMetre * s.range),
                                       aside / data.config().bearing.sigma));
    }
    sum += std::log(test::modelled(best, 1.0, range.outliers));
  }
  return sum;
}

TEST(UnidentifiedSight, WeighsASightingByTheLandmarkThatFitsBest) {
  const auto data = learned(kPoints, config(kPoints));
  Random random(1);
  for (int i = 0; i < 300; ++i) {
    const Pose2 truth = somewhere(random);
    const auto weigher = seenFrom(*data, kPoints, truth);
    ASSERT_NE(weigher, nullptr);
    EXPECT_GT(weigher->getProbability(truth), 0.99);
    const Pose2 near{truth.x + random.uniform(-0.05, 0.05), truth.y + random.uniform(-0.05, 0.05),
                     wrapAngle(truth.theta + random.uniform(-0.02, 0.02))};
    // Errors are taken along and across the sighting, which bends a little where it is near.
    EXPECT_NEAR(std::log(weigher->getProbability(near)), modelled(*data, kPoints, near), 0.25);
    EXPECT_NEAR(test::batchOfOne(*weigher, near), std::log(weigher->getProbability(near)), 1e-4);
  }
}

TEST(UnidentifiedSight, GivesTheFloorOfOutliersToWhatIsNowhere) {
  const auto data = learned(kPoints, config(kPoints));
  data->setData(1, LandmarksData::encode({{LandmarksData::kUnknown, 12.0, 0.0},
                                          {LandmarksData::kUnknown, 0.7, 1.0}}));
  const auto weigher = data->weigher();
  ASSERT_NE(weigher, nullptr);
  EXPECT_NEAR(weigher->getProbability({0, 0, 0}), 0.1 * 0.1, 1e-4);
  EXPECT_EQ(weigher->getProbability({50, 0, 0}), kNoExpectation);
  EXPECT_NEAR(test::batchOfOne(*weigher, {50, 0, 0}), 2 * std::log(0.1), 1e-4);
}

TEST(UnidentifiedSight, LeadsToThePoseFromATenthOfAMetreOff) {
  const auto data = learned(kPoints, config(kPoints));
  Random random(2);
  for (int i = 0; i < 100; ++i) {
    const Pose2 truth = somewhere(random);
    const auto weigher = seenFrom(*data, kPoints, truth);
    const auto* reading = dynamic_cast<const Polishable*>(weigher.get());
    ASSERT_NE(reading, nullptr);
    Pose2 pose{truth.x + 0.06, truth.y - 0.08, wrapAngle(truth.theta + 0.02)};
    for (int step = 0; step < 8; ++step) {
      const Slope slope = reading->slopeAt(pose);
      const Eigen::Vector3d by = Eigen::Map<const Eigen::Matrix3d>(slope.information.data())
                                     .ldlt()
                                     .solve(Eigen::Map<const Eigen::Vector3d>(slope.pull.data()));
      pose = {pose.x + by.x(), pose.y + by.y(), wrapAngle(pose.theta + by.z())};
    }
    EXPECT_LT(std::hypot(pose.x - truth.x, pose.y - truth.y), 0.002);
    EXPECT_LT(std::abs(wrapAngle(pose.theta - truth.theta)), 0.001);
  }
}

TEST(UnidentifiedSight, IsWiderIfThePoseIsNotKnownWell) {
  const auto data = learned(kPoints, config(kPoints));
  const Pose2 truth{0.2, -0.4, 0.7};
  const Pose2 off{0.5, -0.4, 0.7};
  const auto weigher = seenFrom(*data, kPoints, truth);
  const auto* sharp = dynamic_cast<const BlurrableWeigher*>(weigher.get());
  ASSERT_NE(sharp, nullptr);
  EXPECT_LT(sharp->getProbability(off), 0.01);
  EXPECT_GT(sharp->blurred({.metres = 0.3, .radians = 0.1})->getProbability(off), 0.1);
}

TEST(UnidentifiedSight, ComesOutOfATableFileAsItWent) {
  const auto data = learned(kPoints, config(kPoints));
  const test::TemporaryFolder folder;
  TableWriter writer(folder / "t.ortung");
  data->saveTables(writer, "f.");
  writer.commit();
  LandmarksData other({"M", "T", "F"}, kMount, config(kPoints));
  EXPECT_EQ(other.learningKey(), data->learningKey());
  const auto file = std::make_shared<TableFile>(folder / "t.ortung");
  other.loadTables(file, "f.", kRoom.region(0.1, 0.2).grid);
  const Pose2 truth{1.0, -0.3, 2.0};
  const Pose2 off{1.05, -0.33, 2.01};
  EXPECT_EQ(seenFrom(other, kPoints, truth)->getProbability(off),
            seenFrom(*data, kPoints, truth)->getProbability(off));
  LandmarksData fewer({"M", "T", "F"}, kMount, config({kPoints[0]}));
  EXPECT_THROW(fewer.loadTables(file, "f.", kRoom.region(0.1, 0.2).grid), TableError);
}

TEST(UnidentifiedSight, SaysWhichLandmarkASightingIsOf) {
  const auto data = learned(kPoints, config(kPoints));
  const Pose2 robot{0.4, 0.3, -1.0};
  const Pose2 sensor = robot * kMount;
  const double range = std::hypot(3.6 - sensor.x, -2.1 - sensor.y);
  const double bearing = test::bearingTo(sensor, 3.6, -2.1);
  const LandmarksData::Sighting sighting{LandmarksData::kUnknown, range + 0.2, bearing - 0.05};
  EXPECT_EQ(data->indexOf(sighting, robot), 1);
  EXPECT_EQ(data->indexOf({LandmarksData::kUnknown, 30.0, 0.0}, robot), -1);
  const std::vector<double> expected = data->expectation(robot);
  ASSERT_EQ(expected.size(), 6u);
  EXPECT_NEAR(expected[2], range, 0.001);
  EXPECT_NEAR(expected[3], bearing, 0.001);
}

TEST(SightingBias, IsTakenOffWhatWasMeasured) {
  const SightingBias bias{.metres = 0.1,
                          .perMetre = 0.03,
                          .perMetreRad = -0.04,
                          .perMetreRad2 = -0.5,
                          .radians = 0.02,
                          .perRad = 0.05,
                          .perRad2 = -0.06};
  Random random(3);
  for (int i = 0; i < 200; ++i) {
    const SightingBias::Sight truth{random.uniform(0.5, 8.0), random.uniform(-0.8, 0.8)};
    const auto [range, bearing] = bias.corrected(bias.measured(truth));
    EXPECT_NEAR(range, truth.range, 1e-6);
    EXPECT_NEAR(bearing, truth.bearing, 1e-6);
  }
  // By hand: 2 m at 0.5 rad.
  const auto [range, bearing] = bias.measured({2.0, 0.5});
  EXPECT_NEAR(range, 2.0 * (1.0 + 0.03 - 0.02 - 0.125) + 0.1, 1e-12);
  EXPECT_NEAR(bearing, 0.5 + 0.02 + 0.025 - 0.015, 1e-12);
}

TEST(SightingBias, OfAFeatureLeavesItsWordsAndCorrectsWhatIsWeighed) {
  LandmarksData::Config c = config(kPoints);
  c.bias = {.metres = 0.4, .radians = 0.2};
  const auto data = learned(kPoints, c);
  const Pose2 truth{0.3, 0.2, 0.1};
  LandmarksData::Reading reading;
  for (const test::Point& point : kPoints) {
    const Pose2 sensor = truth * kMount;
    reading.push_back({LandmarksData::kUnknown,
                       std::hypot(point.x - sensor.x, point.y - sensor.y) + 0.4,
                       wrapAngle(test::bearingTo(sensor, point.x, point.y) + 0.2)});
  }
  const std::vector<std::uint32_t> words = LandmarksData::encode(reading);
  data->setData(1, words);
  EXPECT_TRUE(std::equal(words.begin(), words.end(), data->getData().begin()));
  EXPECT_GT(data->getProbability(truth), 0.99);
}

}  // namespace
}  // namespace ortung

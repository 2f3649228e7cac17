#include <gtest/gtest.h>

#include <cmath>

#include "FakeRoom.hpp"
#include "Files.hpp"
#include "ortung/formats/ObjectsData.hpp"
#include "ortung/formats/PointsData.hpp"
#include "ortung/tables/TableFile.hpp"

namespace ortung {
namespace {

using test::kPi;
using test::messageOf;
using Words = std::vector<std::uint32_t>;

const SensorId kId{"M1", "T", "F"};

/// A room with one line along y = 1, learned by points from everywhere.
struct LinePoints {
  explicit LinePoints(PointsData::Config config = {.maxRange = 6.0, .model = model()})
      : data(kId, {0.2, 0.1, 0.5}, config) {
    test::learnEverywhere(data, region, kPi / 90, [](const Pose2& sensor) {
      return PointsData::encode(pointsFrom(sensor));
    });
  }
  static SensorModel model() {
    return {.sigma = 0.1, .sigmaPerMetre = 0.0, .outliers = 0.05, .exponent = 0.5};
  }
  /// Points 5 cm apart on the line from (-3, 1) to (3, 1).
  static std::vector<PointsData::Point> pointsFrom(const Pose2& sensor) {
    std::vector<PointsData::Point> points;
    for (int i = 0; i <= 120; ++i) points.push_back(pointAt(sensor, -3.0 + 0.05 * i, 1.025));
    return points;
  }
  static PointsData::Point pointAt(const Pose2& sensor, double x, double y) {
    return {std::hypot(x - sensor.x, y - sensor.y), test::bearingTo(sensor, x, y)};
  }
  const FieldRegion region = test::Room{8, 5}.region(0.25, 0.2);
  PointsData data;
};

TEST(PointsData, ReadsPoints) {
  PointsData data(kId, {}, {});
  data.setData(1, PointsData::encode(std::vector<PointsData::Point>{{2.5, 0.25}, {1.0, -3.0}}));
  ASSERT_EQ(data.reading().size(), 2u);
  EXPECT_NEAR(data.reading()[0].range, 2.5, 0.0005001);
  EXPECT_NEAR(data.reading()[1].bearing, -3.0, 0.5001 * kPi / 18000);
  data.setData(2, {});
  EXPECT_TRUE(data.reading().empty());
}

TEST(PointsData, RefusesHostileWordsAndKeepsItsReading) {
  PointsData data(kId, {}, {});
  data.setData(1, Words{1000, 18000});
  const auto refusal = [&](const Words& words) {
    return messageOf<std::invalid_argument>([&] { data.setData(2, words); });
  };
  EXPECT_EQ(refusal({1000}), "M1/T/F: found 1 words, expected two a point and at most 4096 points");
  EXPECT_EQ(refusal(Words(2 * 4097, 0)),
            "M1/T/F: found 8194 words, expected two a point and at most 4096 points");
  EXPECT_EQ(refusal({1000, 18000, 1, 36000}),
            "M1/T/F: found the angle word 36000, expected below 36000");
  EXPECT_EQ(data.reading().size(), 1u);
  EXPECT_EQ(data.sequence(), 1u);
}

TEST(PointsData, WeighsByTheDistanceFromTheNearestLearnedPoint) {
  LinePoints line;
  const Pose2 robot{0.3, -0.4, 0.2};
  const Pose2 sensor = robot * line.data.mount();
  // Cells are 5 cm; the line's middle is the middle of a row of cells. Points in the middles of
  // the rows 0, 4 and 20 above it.
  const double away[] = {0.0, 0.2, 1.0};
  std::vector<PointsData::Point> points;
  for (const double d : away) points.push_back(LinePoints::pointAt(sensor, 0.525, 1.025 + d));
  line.data.setData(5, PointsData::encode(points));
  const double sigma = std::hypot(0.1, 0.29 * 0.05);
  double expected = 1.0;
  for (const double d : away) expected *= test::modelled(d, sigma, 0.05, 0.5);
  EXPECT_NEAR(line.data.getProbability(robot), expected, 1e-5);
  const std::vector<double> distances = line.data.expectation(robot);
  ASSERT_EQ(distances.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(distances[i], away[i], 0.0032);
}

TEST(PointsData, GrowsItsSigmaWithRange) {
  LinePoints line(
      {.maxRange = 8.0, .model = {.sigma = 0.05, .sigmaPerMetre = 0.1, .outliers = 0.05}});
  // 3.5 m from the line: the class of ranges from 3 to 4 m.
  const Pose2 robot = Pose2{0.0, 1.325 - 3.5, kPi / 2} * inverse(line.data.mount());
  line.data.setData(5, PointsData::encode(std::vector<PointsData::Point>{{3.5, 0.0}}));
  const double sigma = std::hypot(0.05 + 0.1 * 3.5, 0.29 * 0.05);
  EXPECT_NEAR(line.data.getProbability(robot), test::modelled(0.3, sigma, 0.05), 1e-5);
}

TEST(PointsData, ExpectsNothingOutsideAndWithoutPoints) {
  LinePoints line;
  line.data.setData(5, PointsData::encode(std::vector<PointsData::Point>{{1.0, 0.0}}));
  EXPECT_EQ(line.data.getProbability({100, 0, 0}), kNoExpectation);
  // In a set, it gets the floor.
  EXPECT_NEAR(test::batchOfOne(line.data, {100, 0, 0}), 0.5 * std::log(0.05), 1e-6);
  line.data.setData(6, {});
  EXPECT_FALSE(line.data.canWeigh());
  EXPECT_EQ(line.data.getProbability({0, 0, 0}), kNoExpectation);
  // What is beyond its range says nothing.
  line.data.setData(7, Words{4294967295u, 18000, 6001, 18000});
  EXPECT_FALSE(line.data.canWeigh());
}

TEST(PointsData, ThinsEvenly) {
  LinePoints all;
  LinePoints some({.maxRange = 6.0, .usedPoints = 2, .model = LinePoints::model()});
  const Words four = {1000, 18000, 1000, 18500, 1000, 19000, 1000, 19500};
  const Words firstAndThird = {1000, 18000, 1000, 19000};
  some.data.setData(1, four);
  all.data.setData(1, firstAndThird);
  EXPECT_EQ(some.data.getProbability({0.1, 0.5, 0.3}), all.data.getProbability({0.1, 0.5, 0.3}));
}

TEST(PointsData, KeepsItsFieldInAFile) {
  const test::TemporaryFolder folder;
  LinePoints line;
  const Words words = PointsData::encode(LinePoints::pointsFrom({0.3, 0.2, 0.7}));
  line.data.setData(1, words);
  {
    TableWriter writer(folder / "points.npz");
    line.data.saveTables(writer, "p.");
    writer.commit();
  }
  PointsData loaded(kId, line.data.mount(), line.data.config());
  loaded.setData(1, words);
  loaded.loadTables(std::make_shared<TableFile>(folder / "points.npz"), "p.", line.region.grid);
  const Pose2 robot{0.25, 0.15, 0.6};
  EXPECT_EQ(loaded.getProbability(robot), line.data.getProbability(robot));
  EXPECT_GT(loaded.getProbability(robot), 0.0);
}

TEST(ObjectsData, ReadsObjectsAndNeverLocalizes) {
  ObjectsData data(kId);
  const std::vector<ObjectsData::Object> objects = {{7, 0xffa500, 2.5, 0.25, 0.11},
                                                    {0, ObjectsData::kNoColour, 1.0, -1.0, 0.0}};
  data.setData(1, ObjectsData::encode(objects));
  ASSERT_EQ(data.reading().size(), 2u);
  EXPECT_EQ(data.reading()[0].identity, 7u);
  EXPECT_EQ(data.reading()[0].colour, 0xffa500u);
  EXPECT_NEAR(data.reading()[0].radius, 0.11, 0.0005001);
  EXPECT_EQ(data.reading()[1].colour, ObjectsData::kNoColour);
  EXPECT_FALSE(data.localizes());
  EXPECT_FALSE(data.canWeigh());
  EXPECT_EQ(data.getProbability({0, 0, 0}), kNoExpectation);
}

TEST(ObjectsData, RefusesHostileWords) {
  ObjectsData data(kId);
  const auto refusal = [&](const Words& words) {
    return messageOf<std::invalid_argument>([&] { data.setData(2, words); });
  };
  EXPECT_EQ(refusal({1, 2, 3, 4}),
            "M1/T/F: found 4 words, expected five an object and at most 1024 objects");
  EXPECT_NE(refusal(Words(5 * 1025, 0)), "");
  EXPECT_EQ(refusal({0, 16777217, 1, 18000, 1}),
            "M1/T/F: found the colour 16777217, expected at most 16777216");
  EXPECT_EQ(refusal({0, 0, 1, 4294967295u, 1}),
            "M1/T/F: found the angle word 4294967295, expected below 36000");
  EXPECT_EQ(data.sequence(), 0u);
}

}  // namespace
}  // namespace ortung

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "FakeRoom.hpp"
#include "Files.hpp"
#include "ortung/formats/BearingData.hpp"
#include "ortung/formats/ConeData.hpp"
#include "ortung/formats/LandmarksData.hpp"
#include "ortung/formats/OdometryData.hpp"
#include "ortung/formats/PoseData.hpp"
#include "ortung/formats/ScalarData.hpp"
#include "ortung/formats/ScanData.hpp"

namespace ortung {
namespace {

using test::kPi;
using test::messageOf;
using Words = std::vector<std::uint32_t>;

const SensorId kId{"M1", "T", "F"};
constexpr double kInfinity = std::numeric_limits<double>::infinity();
const double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kHalfAngleWord = 0.5001 * kPi / 18000;

/// That @p words are refused with @p reason and that the reading before stays, whole.
void expectRefused(SensorData& data, const Words& good, const Words& words,
                   const std::string& reason) {
  data.setData(7, good);
  const std::uint64_t sequence = data.sequence();
  EXPECT_EQ(messageOf<std::invalid_argument>([&] { data.setData(8, words); }), "M1/T/F: " + reason);
  EXPECT_EQ(Words(data.getData().begin(), data.getData().end()), good);
  EXPECT_EQ(data.stamp(), 7);
  EXPECT_EQ(data.sequence(), sequence);
}

TEST(SensorData, CountsReadingsAndKeepsTheirWordsAndStamp) {
  ScalarData data(kId, {}, {});
  EXPECT_EQ(data.sequence(), 0u);
  data.setData(12, Words{1500});
  EXPECT_EQ(data.sequence(), 1u);
  EXPECT_EQ(data.stamp(), 12);
  EXPECT_EQ(data.getData()[0], 1500u);
  EXPECT_EQ(data.getData().size(), 1u);
}

TEST(SensorData, MayBeSetFromItsOwnWords) {
  OdometryData data(kId);
  const Words words = OdometryData::encode({{1, 2, 0.5}, 0.1, 0.2, {7, 8, 9}});
  data.setData(1, words);
  data.setData(2, data.getData());
  EXPECT_EQ(Words(data.getData().begin(), data.getData().end()), words);
}

TEST(SensorData, RefusesBadNamesAndMounts) {
  for (const std::string name : {"", "a b", "a/b", "ä", "a\n"}) {
    EXPECT_THROW(PoseData({name, "T", "F"}), std::invalid_argument) << name;
    EXPECT_THROW(PoseData({"M", name, "F"}), std::invalid_argument) << name;
    EXPECT_THROW(PoseData({"M", "T", name}), std::invalid_argument) << name;
  }
  EXPECT_THROW(PoseData({std::string(65, 'x'), "T", "F"}), std::invalid_argument);
  EXPECT_NO_THROW(PoseData({std::string(64, 'x'), "T-_.9", "F"}));
  EXPECT_THROW(ScalarData(kId, {kNan, 0, 0}, {}), std::invalid_argument);
  EXPECT_THROW(ScalarData(kId, {0, 0, kInfinity}, {}), std::invalid_argument);
}

TEST(SensorId, RoundTripsThroughItsText) {
  const SensorId id = parseSensorId("LMS200/LRF/180DegreeScan");
  EXPECT_EQ(id, (SensorId{"LMS200", "LRF", "180DegreeScan"}));
  EXPECT_EQ(toText(id), "LMS200/LRF/180DegreeScan");
  for (const char* text :
       {"", "/", "//", "a/b", "a/b/", "/b/c", "a//c", "a/b/c/d", "a/b/c d", "a/*/c"}) {
    EXPECT_THROW(parseSensorId(text), std::invalid_argument) << text;
  }
}

TEST(ScalarData, ReadsADistanceOrNothing) {
  ScalarData data(kId, {}, {});
  data.setData(1, ScalarData::encode(1.2345));
  EXPECT_NEAR(*data.reading(), 1.2345, 0.0005001);
  data.setData(2, ScalarData::encode(std::nullopt));
  EXPECT_FALSE(data.reading().has_value());
  expectRefused(data, {5}, {1, 2}, "found 2 words, expected 1");
}

TEST(BearingData, ReadsABearingOrNothing) {
  BearingData data(kId, {}, {});
  data.setData(1, BearingData::encode(-1.0));
  EXPECT_NEAR(*data.reading(), -1.0, kHalfAngleWord);
  data.setData(2, BearingData::encode(std::nullopt));
  EXPECT_FALSE(data.reading().has_value());
  expectRefused(data, {5}, {1, 2}, "found 2 words, expected 1");
  expectRefused(data, {5}, {36000}, "found the angle word 36000, expected below 36000");
}

TEST(LandmarksData, ReadsSightings) {
  LandmarksData data(kId, {}, {.identities = {3, 1, 4}, .range = {}});
  data.setData(1, LandmarksData::encode({{4, 2.5, 0.25}, {77, 1.0, -3.0}}));
  ASSERT_EQ(data.reading().size(), 2u);
  EXPECT_EQ(data.reading()[0].identity, 4u);
  EXPECT_NEAR(data.reading()[0].range, 2.5, 0.0005001);
  EXPECT_NEAR(data.reading()[0].bearing, 0.25, kHalfAngleWord);
  EXPECT_EQ(data.reading()[1].identity, 77u);
  data.setData(2, {});
  EXPECT_TRUE(data.reading().empty());
  const Words good = {1, 1000, 18000};
  expectRefused(data, good, {1, 1000},
                "found 2 words, expected three a sighting and at most 4096 sightings");
  expectRefused(data, good, Words(3 * 4097, 0),
                "found 12291 words, expected three a sighting and at most 4096 sightings");
  expectRefused(data, good, {1, 1000, 18000, 1, 1000, 36000},
                "found the angle word 36000, expected below 36000");
  EXPECT_EQ(data.reading().size(), 1u);
}

TEST(LandmarksData, RefusesNoOrDoubleIdentities) {
  EXPECT_THROW(LandmarksData(kId, {}, LandmarksData::Config{}), std::invalid_argument);
  EXPECT_THROW(LandmarksData(kId, {}, {.identities = {1, 2, 1}, .range = {}}),
               std::invalid_argument);
}

TEST(ScanData, ReadsRangesNothingAndInvalid) {
  ScanData data(
      kId, {},
      {.beams = 5, .firstAngle = -1.0, .angleStep = 0.5, .minRange = 0.1, .maxRange = 8.0});
  const std::vector<float> ranges = {1.5F, NAN, 9.0F, INFINITY, 0.05F};
  Words words;
  ScanData::encode(ranges, 8.0, words);
  EXPECT_EQ(words, (Words{1500, 0, 8001, 8001, 50}));
  data.setData(1, words);
  const ScanData::Reading reading = data.reading();
  EXPECT_DOUBLE_EQ(reading.firstAngle, -1.0);
  EXPECT_DOUBLE_EQ(reading.angleStep, 0.5);
  ASSERT_EQ(reading.ranges.size(), 5u);
  EXPECT_FLOAT_EQ(reading.ranges[0], 1.5F);
  EXPECT_TRUE(std::isnan(reading.ranges[1]));
  EXPECT_EQ(reading.ranges[2], INFINITY);
  EXPECT_EQ(reading.ranges[3], INFINITY);
  EXPECT_TRUE(std::isnan(reading.ranges[4])) << "nearer than the sensor can measure";
  expectRefused(data, words, {1, 2, 3, 4}, "found 4 words, expected 5");
  expectRefused(data, words, {}, "found 0 words, expected 5");
}

TEST(ScanData, NeverEncodesAReadingAsInvalid) {
  Words words;
  ScanData::encode(std::vector<float>{0.0F, 0.0001F, -5.0F}, 8.0, words);
  EXPECT_EQ(words, (Words{1, 1, 1}));
}

TEST(ScanData, AWordOfTheGreatestRangeOrMoreSeesNothing) {
  ScanData data(kId, {}, {.beams = 4, .angleStep = 0.1, .maxRange = 8.0});
  data.setData(1, Words{7999, 8000, 8001, 0xFFFFFFFF});
  EXPECT_FLOAT_EQ(data.reading().ranges[0], 7.999F);
  for (std::size_t i = 1; i < 4; ++i) EXPECT_EQ(data.reading().ranges[i], INFINITY);
}

TEST(ScanData, RefusesImpossibleGeometry) {
  const auto make = [](int beams, double step) {
    ScanData(kId, {}, {.beams = beams, .angleStep = step});
  };
  EXPECT_THROW(make(0, 0.1), std::invalid_argument);
  EXPECT_THROW(make(-1, 0.1), std::invalid_argument);
  EXPECT_THROW(make(8193, 1e-4), std::invalid_argument);
  EXPECT_THROW(make(10, 0.0), std::invalid_argument);
  EXPECT_THROW(make(10, -0.1), std::invalid_argument);
  EXPECT_THROW(make(10, kNan), std::invalid_argument);
  EXPECT_THROW(make(400, kPi / 180), std::invalid_argument);
  EXPECT_NO_THROW(make(361, kPi / 180));
}

TEST(ConeData, ReadsARangeNothingOrInvalid) {
  ConeData data(kId, {}, {.maxRange = 3.0});
  EXPECT_EQ(ConeData::encode(kNan, 3.0), 0u);
  EXPECT_EQ(ConeData::encode(kInfinity, 3.0), 3001u);
  EXPECT_EQ(ConeData::encode(0.0, 3.0), 1u);
  data.setData(1, Words{1234});
  EXPECT_DOUBLE_EQ(data.reading(), 1.234);
  data.setData(1, Words{3000});
  EXPECT_EQ(data.reading(), kInfinity);
  data.setData(1, Words{0});
  EXPECT_TRUE(std::isnan(data.reading()));
  expectRefused(data, {5}, {}, "found 0 words, expected 1");
  expectRefused(data, {5}, {5, 6}, "found 2 words, expected 1");
}

TEST(OdometryData, ReadsPoseVelocitiesAndMotionData) {
  OdometryData data(kId);
  const Words words = OdometryData::encode({{-1.5, 2.25, -3.0}, -0.5, 0.75, {11, 12}});
  ASSERT_EQ(words.size(), 7u);
  data.setData(1, words);
  EXPECT_DOUBLE_EQ(data.reading().pose.x, -1.5);
  EXPECT_DOUBLE_EQ(data.reading().pose.y, 2.25);
  EXPECT_NEAR(data.reading().pose.theta, -3.0, kHalfAngleWord);
  EXPECT_DOUBLE_EQ(data.reading().translationalVelocity, -0.5);
  EXPECT_NEAR(data.reading().rotationalVelocity, 0.75, kHalfAngleWord);
  EXPECT_EQ(data.reading().motionData, (Words{11, 12}));
  expectRefused(data, words, {1, 2, 3, 4}, "found 4 words, expected 5 to 21");
  expectRefused(data, words, Words(22, 1), "found 22 words, expected 5 to 21");
  expectRefused(data, words, {1, 2, 36000, 4, 5},
                "found the angle word 36000, expected below 36000");
  EXPECT_EQ(data.reading().motionData, (Words{11, 12}));
}

TEST(OdometryData, TellsTheLateralVelocityBehindTheMotionData) {
  OdometryData data(kId);
  const Words words = OdometryData::encode({{1, 2, 0}, 0.25, 0.0, {11, 12, 13}, -1.5});
  EXPECT_EQ(words, (Words{2147484648, 2147485648, 18000, 2147483898, 2147483648, 11, 12, 13,
                          4294967295, 2147482148}));
  data.setData(1, words);
  EXPECT_DOUBLE_EQ(data.reading().lateralVelocity, -1.5);
  EXPECT_EQ(data.reading().motionData, (Words{11, 12, 13}));
  data.setData(2, OdometryData::encode({{}, 0.5, 0.0, Words(16, 7), 0.75}));
  EXPECT_DOUBLE_EQ(data.reading().lateralVelocity, 0.75);
  EXPECT_EQ(data.reading().motionData, Words(16, 7));
  expectRefused(data, words, OdometryData::encode({{}, 0, 0, Words(17, 7), 0.75}),
                "found 24 words, expected 5 to 23");
}

// Records of an omnidirectional base from before there was a lateral velocity.
TEST(OdometryData, ReadsWordsWithoutLateralVelocityAsBefore) {
  OdometryData data(kId);
  const Words old = {2147484648, 2147485648, 18000, 2147483898, 2147483648, 11, 12, 13};
  data.setData(1, OdometryData::encode({{}, 0, 0, {}, 1.0}));
  data.setData(2, old);
  EXPECT_EQ(data.reading().lateralVelocity, 0.0);
  EXPECT_EQ(data.reading().motionData, (Words{11, 12, 13}));
  EXPECT_EQ(OdometryData::encode(data.reading()), old) << "as it was: who stands adds no words";
  for (const Words& motion : {Words{4294967295, 5}, Words{4294967295}, Words{1, 4294967295, 2}}) {
    data.setData(3, OdometryData::encode({{}, 0, 0, motion}));
    EXPECT_EQ(data.reading().motionData, motion) << "though it looks like a lateral velocity";
    EXPECT_EQ(data.reading().lateralVelocity, 0.0);
  }
}

TEST(PoseData, ReadsAPose) {
  PoseData data({"M1", "T", "F"});
  const Words words = PoseData::encode({-10.001, 0.002, kPi / 2});
  data.setData(1, words);
  EXPECT_DOUBLE_EQ(data.reading().x, -10.001);
  EXPECT_DOUBLE_EQ(data.reading().y, 0.002);
  EXPECT_DOUBLE_EQ(data.reading().theta, kPi / 2);
  expectRefused(data, words, {1, 2}, "found 2 words, expected 3");
  expectRefused(data, words, {1, 2, 99999}, "found the angle word 99999, expected below 36000");
}

// Whatever the words are, a format takes them or refuses them; nothing else happens.
TEST(Formats, TakeOrRefuseAnyWords) {
  std::vector<std::unique_ptr<SensorData>> all;
  all.push_back(std::make_unique<ScalarData>(kId, Pose2{}, ScalarData::Config{}));
  all.push_back(std::make_unique<BearingData>(kId, Pose2{}, BearingData::Config{}));
  all.push_back(std::make_unique<LandmarksData>(
      kId, Pose2{}, LandmarksData::Config{.identities = {1, 2}, .range = {}}));
  all.push_back(
      std::make_unique<ScanData>(kId, Pose2{}, ScanData::Config{.beams = 5, .angleStep = 0.1}));
  all.push_back(std::make_unique<ConeData>(kId, Pose2{}, ConeData::Config{}));
  all.push_back(std::make_unique<OdometryData>(kId));
  all.push_back(std::make_unique<PoseData>(kId));
  Random random(1);
  for (int i = 0; i < 50000; ++i) {
    Words words(random.below(9));
    for (std::uint32_t& w : words)
      w = random.below(2) == 0 ? random.next() : static_cast<std::uint32_t>(random.below(40000));
    SensorData& data = *all[random.below(all.size())];
    const std::uint64_t before = data.sequence();
    try {
      data.setData(i, words);
      ASSERT_EQ(data.sequence(), before + 1);
      ASSERT_EQ(Words(data.getData().begin(), data.getData().end()), words);
    } catch (const std::invalid_argument&) {
      ASSERT_EQ(data.sequence(), before);
    }
    ASSERT_EQ(data.getProbability(Pose2{}), kNoExpectation) << "nothing was learned";
  }
}

}  // namespace
}  // namespace ortung

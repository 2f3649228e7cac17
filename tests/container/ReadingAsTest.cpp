#include <gtest/gtest.h>

#include "StrangerData.hpp"
#include "ortung/base/Angles.hpp"
#include "ortung/core/ReadingAs.hpp"
#include "ortung/formats/BearingData.hpp"
#include "ortung/formats/ChangesData.hpp"
#include "ortung/formats/ClustersData.hpp"
#include "ortung/formats/ConeData.hpp"
#include "ortung/formats/FeatureOf.hpp"
#include "ortung/formats/LandmarksData.hpp"
#include "ortung/formats/ObjectsData.hpp"
#include "ortung/formats/OdometryData.hpp"
#include "ortung/formats/PlacesData.hpp"
#include "ortung/formats/PointsData.hpp"
#include "ortung/formats/PoseData.hpp"
#include "ortung/formats/PoseFixData.hpp"
#include "ortung/formats/ProtectionData.hpp"
#include "ortung/formats/SamplesData.hpp"
#include "ortung/formats/ScalarData.hpp"
#include "ortung/formats/ScanData.hpp"
#include "ortung/formats/TalkData.hpp"
#include "ortung/formats/TrackData.hpp"
#include "ortung/formats/WorkData.hpp"

namespace ortung {
namespace {

using test::StrangerData;
using Words = std::vector<std::uint32_t>;

/// Returns what is read as Data from a stranger with this format and these words.
template <class Data>
std::optional<typename Data::Reading> readAs(const std::string& format, const Words& words) {
  StrangerData stranger(format);
  stranger.setData(12, words);
  return readingAs<Data>(stranger);
}

/// Expects that a stranger's words are read as those of Data, which are encoded again.
template <class Data>
void expectRead(const std::string& format, const Words& words) {
  const auto reading = readAs<Data>(format, words);
  ASSERT_TRUE(reading) << format;
  EXPECT_EQ(Data::encode(*reading), words) << format;
  EXPECT_FALSE(readAs<Data>("acme_thing", words)) << format;
}

TEST(ReadingAs, AnyFeatureOfAFormatIsReadWhateverItsClass) {
  expectRead<ScalarData>("range max_m=20", {1500});
  expectRead<ScalarData>("range", {});
  expectRead<BearingData>("bearing", {18'000 + 4'500});
  expectRead<LandmarksData>("landmarks", {7, 2'000, 18'000, 9, 2'500, 17'000});
  expectRead<PointsData>("points", {2'000, 18'000, 2'500, 17'000});
  expectRead<ObjectsData>("objects", ObjectsData::encode({{{3, 0xFF8000, 1.5, 0.25, 0.11}}}));
  expectRead<PoseData>("pose", PoseData::encode({1.25, -2.5, 0.5}));
  expectRead<PoseFixData>(
      "fix", PoseFixData::encode({{{{1, 2, 0.5}, {0.01, 0, 0, 0, 0.01, 0, 0, 0, 0.01}}}}));
  expectRead<OdometryData>("odometry", OdometryData::encode({{1, 2, 0.5}, 0.1, 0.2, {7, 8, 9}}));
  expectRead<TalkData>("talk", TalkData::encode({"blue1", {}}));
  expectRead<PlacesData>("places", {});
}

TEST(ReadingAs, WhatALocalizationReportsIsReadToo) {
  expectRead<TrackData>("track status=tracking,uncertain,lost",
                        TrackData::encode({TrackStatus::kUncertain, TrackReason::kRival, 0.25, 0.5,
                                           9, Relocalization::kDelay}));
  expectRead<ClustersData>(
      "clusters",
      ClustersData::encode({{{0.75, {{1, 2, 0.5}, {0.01, 0, 0, 0, 0.01, 0, 0, 0, 0.01}}}}}));
  expectRead<ProtectionData>("protection", ProtectionData::encode({0.25, 0.5}));
  expectRead<ChangesData>("changes", ChangesData::encode({0.1, {{true, true, 1.0, -2.0, 3, 1}}}));
  expectRead<WorkData>("work", WorkData::encode({2'000, 150.0, 0.004, 77}));
  expectRead<SamplesData>("samples",
                          SamplesData::encode({{{{1, 2, 0.5}, 1.0}, {{3, 4, 1.5}, 0.5}}}));
}

TEST(ReadingAs, ParametersOfTheFormatSayWhatWordsMean) {
  const auto scan = readAs<ScanData>("scan beams=3 first_deg=-90 step_deg=90 max_m=8 min_m=0.5",
                                     {400, 2'000, 8'001});
  ASSERT_TRUE(scan);
  EXPECT_DOUBLE_EQ(scan->firstAngle, -0.25 * kTurn);
  EXPECT_DOUBLE_EQ(scan->angleStep, 0.25 * kTurn);
  EXPECT_TRUE(std::isnan(scan->ranges[0]));
  EXPECT_FLOAT_EQ(scan->ranges[1], 2.0F);
  EXPECT_TRUE(std::isinf(scan->ranges[2]));
  EXPECT_DOUBLE_EQ(*readAs<ConeData>("cone opening_deg=20 max_m=3", {2'999}), 2.999);
  EXPECT_TRUE(std::isinf(*readAs<ConeData>("cone opening_deg=20 max_m=2", {2'999})));
}

TEST(ReadingAs, AFeatureThatOnlyClaimsAFormatIsNotRead) {
  // Parameters are missing, or no such feature has them.
  EXPECT_FALSE(readAs<ScanData>("scan beams=3 max_m=8", {1, 2, 3}));
  for (const char* beams : {"0", "2.5", "8193", "1e300", "nan", "-1"})
    EXPECT_FALSE(readAs<ScanData>(
        "scan first_deg=0 step_deg=0.01 max_m=8 beams=" + std::string(beams), {1, 2, 3}))
        << beams;
  EXPECT_FALSE(readAs<ConeData>("cone max_m=2", {1}));
  // The words are not those of the format.
  EXPECT_FALSE(readAs<ScanData>("scan beams=3 first_deg=0 step_deg=1 max_m=8", {1, 2}));
  EXPECT_FALSE(readAs<BearingData>("bearing", {36'000}));
  EXPECT_FALSE(readAs<TrackData>("track", {0, 0, 0, 10'001}));
  EXPECT_FALSE(readAs<ClustersData>("clusters", {1, 2, 3}));
}

TEST(ReadingAs, NothingIsReadBeforeTheFirstReading) {
  EXPECT_FALSE(readingAs<PoseData>(StrangerData("pose")));
  EXPECT_FALSE(readingAs<PoseData>(PoseData({"a", "b", "c"})));
}

TEST(ReadingAs, AFeatureOfTheClassIsReadItself) {
  ScalarData data({"a", "b", "c"}, {}, {});
  data.setData(1, Words{1500});
  EXPECT_DOUBLE_EQ(**readingAs<ScalarData>(data), 1.5);
}

TEST(Like, KeepsNameMountStampAndWords) {
  StrangerData stranger("range max_m=4", {1, 2, 0.5});
  stranger.setData(12, Words{1500});
  const auto same = like<ScalarData>(stranger);
  ASSERT_TRUE(same);
  EXPECT_EQ(same->id(), stranger.id());
  EXPECT_EQ(same->mount().x, 1.0);
  EXPECT_EQ(same->mount().theta, 0.5);
  EXPECT_EQ(same->stamp(), 12);
  EXPECT_EQ(same->config().maxRange, 4.0);
  EXPECT_EQ(Words(same->getData().begin(), same->getData().end()), Words{1500});
}

TEST(FeatureOf, MakesFeaturesOfEachFormatOfItsRoomAndOfNoOther) {
  const SensorId id{"a", "b", "c"};
  for (const char* format : {"range", "bearing", "cone opening_deg=20 max_m=3",
                             "scan beams=3 first_deg=0 step_deg=1 max_m=8", "landmarks", "points",
                             "fix", "pose", "odometry", "objects", "obstacles", "talk", "places"}) {
    const auto feature = featureOf(id, {}, parseFormat(format));
    ASSERT_TRUE(feature) << format;
    EXPECT_EQ(feature->id(), id);
    EXPECT_EQ(feature->format().name(), parseFormat(format).name());
  }
  EXPECT_EQ(featureOf(id, {}, parseFormat("image")), nullptr);
  EXPECT_EQ(featureOf(id, {}, parseFormat("acme_thing")), nullptr);
  EXPECT_THROW(featureOf(id, {}, parseFormat("scan beams=3")), std::invalid_argument);
}

TEST(FeatureOf, LandmarksHaveTheIdentitiesOfATypicalReading) {
  const Words words = {9, 2'000, 18'000, 7, 2'500, 17'000, 9, 100, 18'000};
  const auto feature = featureOf({"a", "b", "c"}, {}, parseFormat("landmarks"), words);
  const auto& landmarks = dynamic_cast<const LandmarksData&>(*feature);
  EXPECT_EQ(landmarks.config().identities, (std::vector<std::uint32_t>{7, 9}));
  EXPECT_EQ(landmarks.indexOf(9u), 1);
  EXPECT_EQ(landmarks.indexOf(8u), -1);
}

}  // namespace
}  // namespace ortung

// What a localization publishes beside its pose: what bounds its error, samples, places, work.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "Files.hpp"
#include "RoomRun.hpp"
#include "ortung/formats/ChangesData.hpp"
#include "ortung/formats/ClustersData.hpp"
#include "ortung/formats/PoseData.hpp"
#include "ortung/formats/ProtectionData.hpp"
#include "ortung/formats/SamplesData.hpp"
#include "ortung/formats/WorkData.hpp"
#include "ortung/run/Published.hpp"

namespace ortung::test {
namespace {

template <class Data>
std::string toldOf(std::vector<std::uint32_t> words) {
  Data data;
  return messageOf<std::invalid_argument>([&] { data.setData(1, words); });
}

template <class Data>
void expectRefused(const std::vector<std::uint32_t>& words, const char* text) {
  EXPECT_NE(toldOf<Data>(words).find(text), std::string::npos) << toldOf<Data>(words);
}

TEST(SamplesData, HasTheWordsThatTheProtocolStates) {
  constexpr float kLn5 = 1.609437912F;
  const SampleSet samples{
      {1.5F, -0.25F}, {0.0F, 2.0F}, {0.0F, -1.570796327F}, {-3.0F, -3.0F - kLn5}};
  const Message message = samplesMessage(7, samples);
  EXPECT_EQ(toText(message.id), "mcl/LOCALIZATION/samples");
  constexpr std::uint32_t kZero = 1u << 31;
  EXPECT_EQ(message.words, (std::vector<std::uint32_t>{kZero + 1500, kZero, 0, 65535, kZero - 250,
                                                       kZero + 2000, 27000, 13107}));
  SamplesData data;
  data.setData(message.stamp, message.words);
  const SamplesData::Reading reading = data.reading();
  ASSERT_EQ(reading.size(), 2U);
  EXPECT_NEAR(reading[1].pose.x, -0.25, 1e-9);
  EXPECT_NEAR(reading[1].pose.theta, -kPi / 2, 1e-9);
  EXPECT_NEAR(reading[1].weight, 0.2, 1e-4);
  EXPECT_FALSE(data.localizes());
}

TEST(SamplesData, OfManyTellsThoseThatAreEvenlySpread) {
  SampleSet samples;
  samples.resize(25'000);
  for (std::size_t i = 0; i < samples.size(); ++i) samples.x[i] = 1e-3F * static_cast<float>(i);
  const std::vector<std::uint32_t> words = samplesMessage(0, samples).words;
  ASSERT_EQ(words.size(), 4 * SamplesData::kMostSamples);
  for (std::size_t k = 0; k < SamplesData::kMostSamples; ++k)
    ASSERT_EQ(words[4 * k] - (1u << 31), 5 * k / 2) << "every second or third";
  EXPECT_TRUE(samplesMessage(0, {}).words.empty());
}

TEST(SamplesData, WhereAllAreLostNoneOutweighsAnother) {
  constexpr float kLost = -std::numeric_limits<float>::infinity();
  const auto words = samplesMessage(0, {{0, 0}, {0, 0}, {7.0F, -9.0F}, {kLost, kLost}}).words;
  EXPECT_EQ(words[3], words[7]);
  EXPECT_LT(words[2], 36'000U);
  EXPECT_LT(words[6], 36'000U);
}

TEST(ClustersData, HasTheWordsThatTheProtocolStates) {
  PoseEstimate place;
  place.pose = {1.0, -2.0, 0.0};
  place.covariance = {0.01, 0, 0, 0, 0.04, 0, 0, 0, 0.0001};
  place.share = 0.75;
  const Message message = clustersMessage(9, std::span(&place, 1));
  EXPECT_EQ(toText(message.id), "mcl/LOCALIZATION/places");
  ASSERT_EQ(message.words.size(), 10U);
  EXPECT_EQ(message.words[0], 7500U);
  EXPECT_EQ(message.words[4], 100'000U) << "um";
  ClustersData data;
  data.setData(9, message.words);
  ASSERT_EQ(data.reading().size(), 1U);
  EXPECT_DOUBLE_EQ(data.reading()[0].share, 0.75);
  EXPECT_NEAR(data.reading()[0].fix.pose.y, -2.0, 1e-9);
  EXPECT_NEAR(data.reading()[0].fix.covariance[4], 0.04, 1e-6);
  EXPECT_FALSE(data.localizes());
}

TEST(ChangesData, HasTheWordsThatTheProtocolStates) {
  using Kind = MapChange::Kind;
  MapChanges changes;
  changes.cells = {{Kind::kGone, 10, -21, 1.025, -2.05, 3, 1, 2, 1, 19'000, false},
                   {Kind::kNew, -1, 0, -0.05, 0.075, 7, 7, 0, 3, 19'000, true}};
  const Message message = changesMessage(9, changes);
  EXPECT_EQ(message.stamp, 9);
  EXPECT_EQ(toText(message.id), "mcl/LOCALIZATION/map");
  constexpr std::uint32_t kZero = 1U << 31;
  EXPECT_EQ(message.words, (std::vector<std::uint32_t>{100,  // what is sure comes first
                                                       1, 1, kZero - 50, kZero + 75, 7, 0,  //
                                                       0, 0, kZero + 1025, kZero - 2050, 3, 2}));
  ChangesData data;
  data.setData(9, message.words);
  const ChangesData::Reading reading = data.reading();
  EXPECT_NEAR(reading.cell, 0.1, 1e-12);
  ASSERT_EQ(reading.cells.size(), 2U);
  EXPECT_TRUE(reading.cells[0].isNew && reading.cells[0].isSure);
  EXPECT_FALSE(reading.cells[1].isNew || reading.cells[1].isSure);
  EXPECT_NEAR(reading.cells[1].x, 1.025, 1e-9);
  EXPECT_EQ(reading.cells[1].passes, 3U);
  EXPECT_EQ(reading.cells[1].against, 2U);
  EXPECT_FALSE(data.localizes());
}

TEST(ChangesData, OfManyTellsThoseThatAreSure) {
  MapChanges changes;
  for (std::int32_t k = 0; k < 6'000; ++k)
    changes.cells.push_back(
        {MapChange::Kind::kNew, k, 0, 0.1 * k + 0.05, 0.05, 1, 1, 0, 1, 0, k >= 5'500});
  ChangesData data;
  data.setData(0, changesMessage(0, changes).words);
  ASSERT_EQ(data.reading().cells.size(), ChangesData::kMostCells);
  for (std::size_t k = 0; k < ChangesData::kMostCells; ++k)
    ASSERT_EQ(data.reading().cells[k].isSure, k < 500);
}

TEST(ChangesData, RefusesOtherWords) {
  ChangesData data;
  const auto refusal = [&data](const std::vector<std::uint32_t>& words) {
    return messageOf<std::invalid_argument>([&] { data.checkData(words); });
  };
  EXPECT_NO_THROW(data.checkData(std::vector<std::uint32_t>{100}));
  EXPECT_NE(refusal({}).find("expected the edge of a cell first"), std::string::npos);
  EXPECT_NE(refusal({0}).find("found cells of 0 mm, expected 1 to 1000"), std::string::npos);
  EXPECT_NE(refusal({1001}).find("found cells of 1001 mm"), std::string::npos);
  EXPECT_NO_THROW(data.checkData(std::vector<std::uint32_t>{1000}));
  EXPECT_NE(refusal({100, 1}).find("six a cell and at most 5000 cells"), std::string::npos);
  EXPECT_NE(refusal({100, 2, 0, 1, 1, 1, 0}).find("kind of change 2"), std::string::npos);
  EXPECT_NE(refusal({100, 1, 2, 1, 1, 1, 0}).find("sign of being sure 2"), std::string::npos);
  std::vector<std::uint32_t> many(1 + 6 * 5'001, 1);
  EXPECT_NE(refusal(many).find("at most 5000 cells"), std::string::npos);
}

TEST(SmoothPose, IsAPoseOfItsOwn) {
  PoseEstimate estimate;
  estimate.stamp = 9;
  estimate.pose = {1.0, 2.0, 0.0};
  estimate.smooth = {1.25, -0.5, kPi / 2};
  const Message message = smoothMessage(estimate);
  EXPECT_EQ(message.stamp, 9);
  EXPECT_EQ(toText(message.id), "mcl/LOCALIZATION/smooth");
  EXPECT_EQ(message.words, PoseData::encode(estimate.smooth));
}

ProtectionData::Reading told(const PoseEstimate& estimate) {
  ProtectionData data;
  const Message message = protectionMessage(estimate);
  data.setData(message.stamp, message.words);
  return data.reading();
}

TEST(ProtectionData, HasTheWordsThatTheProtocolStates) {
  PoseEstimate estimate;
  estimate.stamp = 9;
  estimate.protection = {0.125, kPi / 180.0};
  const Message message = protectionMessage(estimate);
  EXPECT_EQ(message.stamp, 9);
  EXPECT_EQ(toText(message.id), "mcl/LOCALIZATION/protection");
  EXPECT_EQ(message.words, (std::vector<std::uint32_t>{125'000, 10'000}));
  EXPECT_DOUBLE_EQ(told(estimate).metres, 0.125);
  EXPECT_NEAR(told(estimate).radians, kPi / 180.0, 1e-12);
  EXPECT_FALSE(ProtectionData().localizes());
}

TEST(ProtectionData, IsNeverLessThanTheBoundThatItTells) {
  Random random(4, 2);
  for (int i = 0; i < 1000; ++i) {
    PoseEstimate estimate;
    estimate.protection = {10.0 * random.uniform(), kPi * random.uniform()};
    const auto [metres, radians] = told(estimate);
    // But for the millionth of a word that what was itself made of words is rounded by.
    EXPECT_GE(metres, estimate.protection.metres - 1e-12);
    EXPECT_LT(metres, estimate.protection.metres + 1e-6);
    EXPECT_GE(radians, estimate.protection.radians - 1e-11);
    EXPECT_LT(radians, estimate.protection.radians + 1e-4 * kPi / 180.0);
    EXPECT_EQ(ProtectionData::encode({metres, radians}), protectionMessage(estimate).words)
        << "what was decoded has the same words";
  }
}

TEST(ProtectionData, TellsWhatNothingBounds) {
  constexpr std::uint32_t kNone = 4'294'967'295U;
  EXPECT_EQ(protectionMessage(PoseEstimate()).words, (std::vector<std::uint32_t>{kNone, kNone}));
  EXPECT_TRUE(std::isinf(told(PoseEstimate()).metres));
  EXPECT_TRUE(std::isinf(told(PoseEstimate()).radians));
  EXPECT_EQ(ProtectionData::encode({std::nan(""), 1e30}),
            (std::vector<std::uint32_t>{kNone, kNone}));
  EXPECT_EQ(ProtectionData::encode({-1.0, 0.0}), (std::vector<std::uint32_t>{0, 0}));
}

TEST(WorkData, HasTheWordsThatTheProtocolStates) {
  const Message message = WorkData::message(9, {1000, 612.4, 0.00125, 17});
  EXPECT_EQ(toText(message.id), "mcl/LOCALIZATION/work");
  EXPECT_EQ(message.words, (std::vector<std::uint32_t>{1000, 612, 1250, 17}));
  EXPECT_EQ(WorkData::encode({0, std::nan(""), 1e30, 0})[2], 4'294'967'295U);
}

TEST(PublishedFormats, RefuseWhatCannotBe) {
  expectRefused<SamplesData>({1, 2, 3}, "found 3 words, expected four a sample");
  expectRefused<SamplesData>(std::vector<std::uint32_t>(40'004, 0), "at most 10000 samples");
  expectRefused<SamplesData>({0, 0, 36'000, 0}, "found the heading 36000, expected below 36000");
  expectRefused<SamplesData>({0, 0, 0, 65'536}, "found the weight 65536, expected 0 to 65535");
  expectRefused<ClustersData>({1, 2, 3}, "found 3 words, expected ten a place");
  expectRefused<ClustersData>(std::vector<std::uint32_t>(650, 1), "at most 64 places");
  expectRefused<ClustersData>({10'001, 0, 0, 0, 1, 1, 1, 0, 0, 0}, "found the share 10001");
  expectRefused<ClustersData>({5, 0, 0, 36'000, 1, 1, 1, 0, 0, 0}, "found the angle word 36000");
  expectRefused<ClustersData>({5, 0, 0, 0, 0, 1, 1, 0, 0, 0}, "found a sigma of 0");
  expectRefused<ProtectionData>({1}, "found 1 words, expected 2");
  expectRefused<WorkData>({1, 1, 1}, "found 3 words, expected 4");
  expectRefused<WorkData>({5, 6, 0, 0}, "found 5 samples worth 6");
}

using Publishing = RoomRun;

TEST_F(Publishing, SamplesAreSetOnlyWhileSomebodyWantsThem) {
  LocalizationConfig config = fromRecord();
  config.publish = true;
  Localization localization(config);
  const auto count = [&](const char* feature) {
    return localization.container().findExactly({"mcl", "LOCALIZATION", feature})->sequence();
  };
  ASSERT_TRUE(localization.next());
  EXPECT_EQ(count("samples"), 0U);
  EXPECT_EQ(count("places"), 1U);
  EXPECT_EQ(count("work"), 1U);
  EXPECT_EQ(count("smooth"), 1U);
  EXPECT_EQ(count("protection"), 1U);
  localization.wantSamples(true);
  const auto estimate = localization.next();
  ASSERT_TRUE(estimate);
  const auto* samples = dynamic_cast<const SamplesData*>(
      localization.container().findExactly({"mcl", "LOCALIZATION", "samples"}));
  ASSERT_NE(samples, nullptr);
  EXPECT_EQ(samples->stamp(), estimate->stamp);
  EXPECT_EQ(samples->reading().size(), localization.mcl().samples().size());
  const auto work = localization.container().get<WorkData>({.feature = "work"});
  EXPECT_EQ(work->samples, localization.mcl().samples().size());
  EXPECT_EQ(work->estimates, 2U);
  EXPECT_GE(work->effectiveSamples, 1.0);
  const auto places = localization.container().get<ClustersData>({.feature = "places"});
  ASSERT_FALSE(places->empty());
  EXPECT_NEAR(places->front().fix.pose.x, estimate->pose.x, 0.02)
      << "of the samples after resampling, the estimate of those before";
  localization.wantSamples(false);
  ASSERT_TRUE(localization.next());
  EXPECT_EQ(count("samples"), 1U);
}

TEST_F(Publishing, APoseOffTheMapIsRefusedBeforeItIsSet) {
  const Localization localization(config());
  localization.checkPose({1.0, 0.5, 0.0}, 0.3);
  EXPECT_THROW(localization.checkPose({100.0, 0.0, 0.0}, 0.3), std::invalid_argument);
  EXPECT_THROW(localization.checkPose({std::nan(""), 0.0, 0.0}, 0.3), std::invalid_argument);
}

TEST(PublishedFormats, AreOfTheirNames) {
  EXPECT_EQ(ProtectionData().format().toText(), "protection");
  EXPECT_EQ(ClustersData().format().toText(), "clusters");
  EXPECT_EQ(WorkData().format().toText(), "work");
  EXPECT_EQ(SamplesData().format().toText(), "samples");
}

}  // namespace
}  // namespace ortung::test

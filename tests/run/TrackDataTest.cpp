#include <gtest/gtest.h>

#include <cmath>

#include "Files.hpp"
#include "ortung/formats/TrackData.hpp"
#include "ortung/run/Published.hpp"

namespace ortung::test {
namespace {

TEST(TrackData, HasTheWordsThatTheProtocolStates) {
  PoseEstimate estimate;
  estimate.stamp = 7;
  estimate.status = TrackStatus::kUncertain;
  estimate.reason = TrackReason::kRival;
  estimate.quality = 0.81234;
  estimate.share = 0.5;
  estimate.relocalizations = 4;
  estimate.relocalization = Relocalization::kOtherPlace;
  const Message message = trackMessage(estimate);
  EXPECT_EQ(message.stamp, 7);
  EXPECT_EQ(toText(message.id), "mcl/LOCALIZATION/status");
  EXPECT_EQ(message.words, (std::vector<std::uint32_t>{1, 6, 8123, 5000, 4, 3}));
  TrackData data;
  data.setData(message.stamp, message.words);
  EXPECT_EQ(data.reading().status, TrackStatus::kUncertain);
  EXPECT_EQ(data.reading().reason, TrackReason::kRival);
  EXPECT_DOUBLE_EQ(data.reading().quality, 0.8123);
  EXPECT_DOUBLE_EQ(data.reading().share, 0.5);
  EXPECT_EQ(data.reading().relocalizations, 4U);
  EXPECT_EQ(data.reading().relocalization, Relocalization::kOtherPlace);
  EXPECT_FALSE(data.canWeigh());
  EXPECT_FALSE(data.localizes());
}

TEST(TrackData, NoNumberIsSureOfNothing) {
  PoseEstimate estimate;
  estimate.quality = std::nan("");
  estimate.share = 1.0 + 1e-9;
  EXPECT_EQ(trackMessage(estimate).words, (std::vector<std::uint32_t>{2, 3, 0, 10000, 0, 0}));
}

TEST(TrackData, OlderRecordsSayNothingOfRelocalizations) {
  TrackData data;
  data.setData(1, std::vector<std::uint32_t>{0, 0, 9000, 10'000, 7, 5});
  data.setData(2, std::vector<std::uint32_t>{1, 6, 8123, 5000});
  EXPECT_EQ(data.reading().reason, TrackReason::kRival);
  EXPECT_DOUBLE_EQ(data.reading().share, 0.5);
  EXPECT_EQ(data.reading().relocalizations, 0U);
  EXPECT_EQ(data.reading().relocalization, Relocalization::kNone);
}

TEST(TrackData, RefusesWhatCannotBe) {
  TrackData data;
  const auto told = [&](std::vector<std::uint32_t> words) {
    return messageOf<std::invalid_argument>([&] { data.setData(1, words); });
  };
  const auto expectTold = [&](const std::vector<std::uint32_t>& words, const char* text) {
    EXPECT_NE(told(words).find(text), std::string::npos) << told(words);
  };
  expectTold({1, 1, 1}, "found 3 words, expected 6");
  expectTold({1, 1, 1, 1, 1}, "found 5 words, expected 6");
  expectTold({3, 0, 0, 0}, "found the status 3, expected 0 to 2");
  expectTold({0, 12, 0, 0}, "found the reason 12, expected 0 to 11");
  expectTold({0, 0, 10001, 0}, "found the quality 10001, expected 0 to 10000");
  expectTold({0, 0, 0, 10001}, "found the share 10001, expected 0 to 10000");
  expectTold({0, 0, 0, 0, 1, 6}, "found the cause 6, expected 0 to 5");
  EXPECT_EQ(data.sequence(), 0U);
  data.setData(1, std::vector<std::uint32_t>{2, 11, 10000, 10000});
  EXPECT_EQ(data.sequence(), 1U);
}

TEST(TrackData, ItsFormatNamesEveryStatusReasonAndCause) {
  EXPECT_EQ(TrackData().format().toText(),
            "track status=tracking,uncertain,lost reason=readings_fit,several_places_fit,"
            "the_belief_is_spread,no_reading_comes,"
            "a_device_repeats_its_reading_though_the_robot_moves,"
            "readings_fit_worse_than_usual,readings_fit_elsewhere,"
            "readings_contradict_odometry,the_field_is_searched,readings_are_late,"
            "few_readings_have_confirmed_the_place_yet,"
            "no_turn_has_shown_yet_that_readings_are_in_time "
            "cause=none,a_global_start_found_the_robot,a_pose_was_given,"
            "readings_fit_another_place_better,readings_are_late_by_another_time,"
            "readings_corrected_it");
}

TEST(TrackData, ItsHelpNamesEveryStatusReasonAndCause) {
  const std::string help = TrackData().wordsHelp();
  EXPECT_EQ(help.find('\n'), std::string::npos);
  for (const char* text :
       {"0 tracking", "1 uncertain", "2 lost", "0 readings fit", "3 no reading comes",
        "7 readings contradict odometry", "8 the field is searched", "9 readings are late",
        "10 few readings have confirmed the place yet",
        "11 no turn has shown yet that readings are in time", "0 none", "5 readings corrected it"})
    EXPECT_NE(help.find(text), std::string::npos) << text;
}

}  // namespace
}  // namespace ortung::test

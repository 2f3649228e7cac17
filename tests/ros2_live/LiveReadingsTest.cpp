// Messages of ROS 2 become moments in the order of time, whatever arrives, and in whatever order.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <thread>

#include "LiveReadings.hpp"
#include "ortung/formats/OdometryData.hpp"
#include "ortung/formats/ScanData.hpp"
#include "ortung/ros2/RobotTopics.hpp"

namespace ortung::ros2 {
namespace {

constexpr Timestamp kBegin = 1'000'000'000;
const SensorId kOdometry{"odometry", "odometry", "pose"};
const SensorId kScan{"laser", "LRF", "scan"};
using std::chrono::milliseconds;

class LiveReadingsTest : public testing::Test {
 protected:
  static LiveReadings::Options options() {
    LiveReadings::Options options;
    options.scanners = {{"scan", kScan, 5, 10.0}};
    options.odometry = kOdometry;
    options.base = "base_link";
    options.patience = milliseconds(600'000);  // on a busy machine, too
    return options;
  }
  void scan(double seconds, std::vector<float> ranges = {1, 2, 3, 4, 5}, float step = 0.1F) {
    LaserScan scan;
    scan.header = {1000 * (kBegin + static_cast<Timestamp>(seconds * 1e6)), "laser"};
    scan.angleMin = -2 * step;
    scan.angleIncrement = step;
    scan.angleMax = 2 * step;
    scan.rangeMax = 10.0F;
    scan.ranges = std::move(ranges);
    readings_.takeScan(0, toCdr(scan));
  }
  static Odometry odometryAt(double seconds, double x = 0.0) {
    Odometry moved;
    moved.header = {1000 * (kBegin + static_cast<Timestamp>(seconds * 1e6)), "odom"};
    moved.childFrame = "base_link";
    moved.pose = fromPose2({x, 0.0, 0.0});
    return moved;
  }
  void odometry(double seconds, double x = 0.0) {
    readings_.takeOdometry(toCdr(odometryAt(seconds, x)));
  }
  void transform(const std::string& parent, const std::string& child, const Pose& pose,
                 double seconds, bool isStatic) {
    TfMessage message;
    message.transforms.push_back(
        {{1000 * (kBegin + static_cast<Timestamp>(seconds * 1e6)), parent}, child, pose});
    readings_.takeTransforms(toCdr(message), isStatic);
  }
  /// The next moment that is ready now, as "SECONDS: features"; "" if there is none.
  std::string next() {
    const auto moment = readings_.next(milliseconds(0));
    if (!moment || moment->readings.empty()) return "";
    std::string text = std::to_string((moment->readings.front().stamp - kBegin) / 1000) + " ms:";
    for (const Message& message : moment->readings) text += " " + message.id.type;
    return text;
  }
  std::uint64_t leftOut(const std::string& part) const {
    std::uint64_t count = 0;
    for (const auto& [what, times] : readings_.leftOut())
      if (what.find(part) != what.npos) count += times;
    return count;
  }
  LiveReadings readings_{options()};
};

TEST_F(LiveReadingsTest, AScanWaitsForOdometryOfItsTime) {
  odometry(0.0);
  scan(0.05);
  EXPECT_EQ(next(), "0 ms: odometry");
  EXPECT_EQ(next(), "");
  odometry(0.1);
  EXPECT_EQ(next(), "50 ms: LRF");
  EXPECT_EQ(next(), "") << "odometry waits for the scan that may come";
}

TEST_F(LiveReadingsTest, OdometryThatCameFirstIsPassedInTheOrderOfTime) {
  odometry(0.0);
  odometry(0.1);
  odometry(0.2);
  scan(0.1);  // takes its time
  EXPECT_EQ(next(), "0 ms: odometry");
  EXPECT_EQ(next(), "100 ms: odometry LRF");
  EXPECT_EQ(next(), "");
}

// So a scan corrects the transform at once, not with the next odometry that the filter gets.
TEST_F(LiveReadingsTest, BetweenTwoOdometriesThePoseIsInterpolated) {
  odometry(0.0, 1.0);
  scan(0.05);
  odometry(0.2, 3.0);
  ASSERT_EQ(next(), "0 ms: odometry");
  const auto moment = readings_.next(milliseconds(0));
  ASSERT_TRUE(moment && moment->inOdometry);
  EXPECT_EQ(moment->readings.front().id, kScan);
  EXPECT_NEAR(moment->inOdometry->x, 1.5, 1e-12);
}

TEST_F(LiveReadingsTest, NothingWaitsForEver) {
  LiveReadings::Options hasty = options();
  hasty.patience = milliseconds(10);
  LiveReadings readings(hasty);
  readings.takeOdometry(toCdr(odometryAt(0.0)));
  const auto moment = readings.next(milliseconds(600'000));
  ASSERT_TRUE(moment);
  ASSERT_EQ(moment->readings.size(), 1u);
  EXPECT_EQ(moment->readings.front().id, kOdometry);
  ASSERT_TRUE(moment->inOdometry);
}

TEST_F(LiveReadingsTest, StopEndsWaiting) {
  std::thread other([&] { readings_.stop(); });
  EXPECT_FALSE(readings_.next(milliseconds(60'000)));
  other.join();
}

TEST_F(LiveReadingsTest, WordsAreThoseOfTheFeatures) {
  odometry(0.0, 1.5);
  scan(0.0, {1.0F, std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(),
             4.0F, 12.0F});
  const auto moment = readings_.next(milliseconds(0));
  ASSERT_TRUE(moment && moment->readings.size() == 2u);
  EXPECT_EQ(moment->readings[0].words, OdometryData::encode({{1.5, 0.0, 0.0}, 0.0, 0.0, {}, 0.0}));
  std::vector<std::uint32_t> expected;
  const float inf = std::numeric_limits<float>::infinity();
  ScanData::encode(std::vector<float>{1.0F, std::nanf(""), inf, 4.0F, 12.0F}, 10.0, expected);
  EXPECT_EQ(moment->readings[1].words, expected);
  ASSERT_TRUE(moment->inOdometry);
  EXPECT_EQ(moment->inOdometry->x, 1.5);
}

TEST_F(LiveReadingsTest, BeamsRunCounterClockwiseSeenFromAbove) {
  transform("base_link", "laser", {{0, 0, 0.3}, {1, 0, 0, 0}}, 0.0, true);  // turned over
  odometry(0.0);
  scan(0.0, {1, 2, 3, 4, 5});
  const auto moment = readings_.next(milliseconds(0));
  std::vector<std::uint32_t> expected;
  ScanData::encode(std::vector<float>{5, 4, 3, 2, 1}, 10.0, expected);
  ASSERT_TRUE(moment && moment->readings.size() == 2u);
  EXPECT_EQ(moment->readings[1].words, expected);
}

TEST_F(LiveReadingsTest, LateMessagesAreLeftOutAndCounted) {
  odometry(1.0);
  scan(1.0);
  EXPECT_EQ(next(), "1000 ms: odometry LRF");
  scan(0.9);
  odometry(0.95);
  EXPECT_EQ(next(), "");
  EXPECT_EQ(leftOut("late"), 2u);
}

TEST_F(LiveReadingsTest, AClockThatWasSetBackIsFollowed) {
  odometry(1000.0);
  scan(1000.0);
  EXPECT_EQ(next(), "1000000 ms: odometry LRF");
  for (int i = 0; i < 200; ++i) odometry(0.02 * i);
  EXPECT_EQ(leftOut("the clock was set back"), 1u);
  scan(3.9);
  EXPECT_EQ(next().substr(0, 5), "1980 ") << "from the message that told of it on";
}

TEST_F(LiveReadingsTest, AScanOfAnotherClockHoldsNothingUp) {
  odometry(0.0);
  scan(1e6);
  scan(0.0);
  EXPECT_EQ(next(), "0 ms: odometry LRF");
  EXPECT_EQ(leftOut("ahead of odometry"), 1u);
}

TEST_F(LiveReadingsTest, FollowsTheFrameOfOdometryIfItIsToldTo) {
  LiveReadings::Options wanted = options();
  wanted.followsFrames = true;
  wanted.patience = milliseconds(10);
  LiveReadings readings(wanted);
  for (const double at : {0.0, 0.1, 0.1, 0.2}) {
    TfMessage message;
    const Timestamp stamp = kBegin + static_cast<Timestamp>(at * 1e6);
    message.transforms.push_back({{1000 * stamp, "odom"}, "base_link", fromPose2({at, 0, 0})});
    message.transforms.push_back({{1000 * stamp, "map"}, "odom", fromPose2({7, 7, 7})});
    readings.takeTransforms(toCdr(message), false);
  }
  const auto moment = readings.next(milliseconds(600'000));
  ASSERT_TRUE(moment && moment->inOdometry);
  EXPECT_EQ(moment->inOdometry->x, 0.0);
  EXPECT_EQ(readings.newestOdometry(), kBegin + 200'000);
}

TEST_F(LiveReadingsTest, WhatDoesNotFitIsLeftOut) {
  const double nan = std::nan("");
  readings_.takeScan(0, "nonsense");
  readings_.takeOdometry("");
  readings_.takeTransforms("\0\1\0\0\xFF\xFF\xFF\xFF", true);
  scan(0.0, {1, 2, 3});  // three beams, the feature has five
  odometry(0.0, nan);
  odometry(0.0, 1e10);
  Odometry fast = odometryAt(0.0);
  fast.linear.x = 1e9;
  readings_.takeOdometry(toCdr(fast));
  transform("base_link", "laser", {{nan, 0, 0}, {}}, 0.0, true);
  transform("base_link", "laser", {{}, {0, 0, 0, 0}}, 0.0, true);
  EXPECT_EQ(leftOut(""), 9u);
  EXPECT_EQ(next(), "");
}

TEST_F(LiveReadingsTest, FloodsEndInCounts) {
  for (int i = 0; i < 10'000; ++i) {
    odometry(0.001 * i);
    transform("base_link", "frame" + std::to_string(i), {}, 0.0, true);
  }
  EXPECT_GT(leftOut("too many that wait"), 0u);
  EXPECT_GT(leftOut("too many frames"), 0u);
}

/// Frames that lead in a circle must not be followed for ever.
TEST_F(LiveReadingsTest, FramesMayLeadInACircle) {
  transform("laser", "base_link", {}, 0.0, true);
  transform("base_link", "laser", {}, 0.0, true);
  odometry(0.0);
  scan(0.0);
  EXPECT_EQ(next(), "0 ms: odometry LRF");
}

// Whatever the order in which they arrive (within what a network does), moments are the same.
TEST_F(LiveReadingsTest, MomentsDoNotDependOnTheOrderOfArrival) {
  std::mt19937 random(7);
  for (int round = 0; round < 50; ++round) {
    LiveReadings readings(options());
    std::vector<std::pair<double, int>> arrivals;  // when, which: even odometry, odd scans
    for (int i = 0; i < 40; ++i) {
      const double latency = std::uniform_real_distribution(0.0, 0.015)(random);
      arrivals.emplace_back(0.02 * i + latency, 2 * i);
      if (i % 5 == 2) arrivals.emplace_back(0.02 * i + 0.007 + 4 * latency, 2 * i + 1);
    }
    std::sort(arrivals.begin(), arrivals.end());
    std::vector<Timestamp> stamps;
    for (const auto& [when, which] : arrivals) {
      const double at = 0.02 * (which / 2) + (which % 2 == 1 ? 0.007 : 0.0);
      if (which % 2 == 0) {
        readings.takeOdometry(toCdr(odometryAt(at)));
      } else {
        LaserScan scan;
        scan.header = {1000 * (kBegin + static_cast<Timestamp>(std::lround(at * 1e6))), "laser"};
        scan.angleIncrement = 0.1F;
        scan.angleMax = 0.4F;
        scan.rangeMax = 10.0F;
        scan.ranges = {1, 2, 3, 4, 5};
        readings.takeScan(0, toCdr(scan));
      }
      while (const auto moment = readings.next(milliseconds(0))) {
        if (moment->readings.empty()) break;
        stamps.push_back(moment->readings.front().stamp);
      }
    }
    EXPECT_TRUE(std::is_sorted(stamps.begin(), stamps.end()));
    EXPECT_TRUE(readings.leftOut().empty());
    EXPECT_GE(stamps.size(), 40u);
  }
}

}  // namespace
}  // namespace ortung::ros2

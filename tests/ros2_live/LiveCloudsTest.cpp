// Clouds of lidars become scans as they arrive.
#include <gtest/gtest.h>

#include <cmath>
#include <thread>

#include "CloudMaker.hpp"
#include "LiveReadings.hpp"
#include "ortung/ros2/RobotTopics.hpp"

namespace ortung::ros2 {
namespace {

using std::chrono::milliseconds;
using testing::CloudForm;
using testing::cloudOf;
using testing::CloudPoint;

constexpr Timestamp kBegin = 1'000'000'000;
const SensorId kLidar{"lidar", "LRF", "scan"};

std::int64_t at(double seconds) { return 1000 * (kBegin + std::llround(seconds * 1e6)); }

/// A lidar half a metre above the robot's frame, with eight beams.
class LiveCloudsTest : public ::testing::Test {
 protected:
  static LiveReadings::Options options(const std::string& level) {
    LiveReadings::Options options;
    options.lidars = {{"points", kLidar, {.beams = 8}}};
    options.odometry = {"odometry", "odometry", "pose"};
    options.base = "base_link";
    options.level = level;
    options.patience = milliseconds(600'000);  // on a busy machine, too
    return options;
  }
  static void mount(LiveReadings& readings, const std::string& frame, const Pose& pose) {
    readings.takeTransforms(toCdr(TfMessage{{{{0, "base_link"}, frame, pose}}}), true);
  }
  static void odometry(LiveReadings& readings, double seconds, double speed = 0.0,
                       const Quaternion& attitude = {}) {
    Odometry moved;
    moved.header = {at(seconds), "odom"};
    moved.pose.orientation = attitude;
    moved.linear.x = speed;
    readings.takeOdometry(toCdr(moved));
  }
  /// The words of the scan of the next moment; none if it has none.
  static std::vector<std::uint32_t> scan(LiveReadings& readings) {
    while (const auto moment = readings.next(milliseconds(0))) {
      if (moment->readings.empty()) return {};
      for (const Message& reading : moment->readings)
        if (reading.id == kLidar) return reading.words;
    }
    return {};
  }
  static std::uint64_t leftOut(const LiveReadings& readings, const std::string& part) {
    std::uint64_t count = 0;
    for (const auto& [what, times] : readings.leftOut())
      if (what.find(part) != what.npos) count += times;
    return count;
  }
};

const std::vector<CloudPoint> kWalls{{-2, 0, 0}, {0, -3, 0}, {4, 0, 0}, {0, 5, 0}};
const std::vector<std::uint32_t> kCross{2000, 0, 3000, 0, 4000, 0, 5000, 0};

TEST_F(LiveCloudsTest, BecomeScansInTheOrderOfTime) {
  LiveReadings readings(options("odometry"));
  mount(readings, "lidar", {{0, 0, 0.5}, {}});
  odometry(readings, 0.0);
  readings.takeCloud(0, toCdr(cloudOf(kWalls, {}, at(0.0))));
  EXPECT_EQ(scan(readings), kCross);
  // A second one has nothing of the first.
  readings.takeCloud(0, toCdr(cloudOf({{1, 0, 0}}, {}, at(0.1))));
  odometry(readings, 0.1);
  EXPECT_EQ(scan(readings), (std::vector<std::uint32_t>{0, 0, 0, 0, 1000, 0, 0, 0}));
  EXPECT_TRUE(readings.leftOut().empty());
}

TEST_F(LiveCloudsTest, WaitForTheTransformThatTellsWhereTheLidarSits) {
  LiveReadings readings(options("odometry"));
  odometry(readings, 0.0);
  readings.takeCloud(0, toCdr(cloudOf(kWalls, {}, at(0.0))));
  EXPECT_TRUE(scan(readings).empty());
  EXPECT_EQ(leftOut(readings, "points: no transform tells where the lidar sits"), 1u);
  mount(readings, "lidar", {{0, 0, 0.5}, {}});
  odometry(readings, 0.1);
  readings.takeCloud(0, toCdr(cloudOf(kWalls, {}, at(0.1))));
  EXPECT_EQ(scan(readings), kCross);
}

TEST_F(LiveCloudsTest, TheMotionThatOdometryTellsIsTakenOut) {
  LiveReadings readings(options("odometry"));
  mount(readings, "lidar", {{0, 0, 0.5}, {}});
  CloudForm form;
  form.fields.push_back({"t", 16, CloudForm::Field::kWord, 1});
  form.pointStep = 20;
  odometry(readings, 0.0, 9.0);
  odometry(readings, 0.1, 1.5);
  odometry(readings, 0.4, 2.5);  // 2 m/s at 0.25 s, when the point was seen
  readings.takeCloud(0, toCdr(cloudOf({{3.9, 0, 0, 50e6}}, form, at(0.2))));
  EXPECT_EQ(scan(readings), (std::vector<std::uint32_t>{0, 0, 0, 0, 4000, 0, 0, 0}));
}

// A robot that leans by 0.2 rad to the right sees the floor there in the heights of walls.
TEST_F(LiveCloudsTest, AreLevelledByWhatTellsTheAttitude) {
  const Quaternion lean{std::sin(0.1), 0, 0, std::cos(0.1)};
  const double c = std::cos(0.2), s = std::sin(0.2);
  const std::vector<CloudPoint> floor{{0, -2 * c, 2 * s - 0.5}, {4, 0, 0}};
  const auto seen = [&](const std::string& level) {
    LiveReadings readings(options(level));
    mount(readings, "lidar", {{0, 0, 0.5}, {}});
    mount(readings, "imu", {{}, {1, 0, 0, 0}});  // upside down
    Imu imu;
    imu.header = {at(0.0), "imu"};
    // Turned by 0.2 rad, then over: the product of both rotations about the x axis.
    imu.orientation = {std::cos(0.1), 0, 0, -std::sin(0.1)};
    if (level == "imu") readings.takeImu(toCdr(imu));
    odometry(readings, 0.0, 0.0, lean);
    readings.takeCloud(0, toCdr(cloudOf(floor, {}, at(0.0))));
    EXPECT_TRUE(readings.leftOut().empty());
    return scan(readings);
  };
  EXPECT_GT(seen("none").at(2), 1900u);
  for (const char* level : {"odometry", "imu"}) {
    EXPECT_EQ(seen(level).at(2), 0u) << level;
    EXPECT_NEAR(seen(level).at(4), 4000.0, 10.0) << level;
  }
}

TEST_F(LiveCloudsTest, WhatDoesNotFitIsLeftOut) {
  LiveReadings readings(options("imu"));
  mount(readings, "lidar", {{0, 0, 0.5}, {}});
  readings.takeImu("nonsense");
  Imu imu;
  imu.header = {at(0.0), "imu"};
  imu.orientationCovariance[0] = -1;
  readings.takeImu(toCdr(imu));
  imu.orientationCovariance[0] = 0;
  imu.orientation = {0, 0, 0, 0};
  readings.takeImu(toCdr(imu));
  EXPECT_EQ(leftOut(readings, "imu: no message"), 1u);
  EXPECT_EQ(leftOut(readings, "imu: no orientation"), 2u);
  readings.takeCloud(0, "nonsense");
  EXPECT_EQ(leftOut(readings, "points: no cloud"), 1u);
  PointCloud broken = cloudOf(kWalls, {}, at(0.0));
  broken.width = 1U << 31;
  readings.takeCloud(0, toCdr(broken));
  EXPECT_EQ(leftOut(readings, "expected 4194304 at most"), 1u);
  readings.takeCloud(0, toCdr(cloudOf({{0, 0, 9}}, {}, at(0.0))));
  EXPECT_EQ(leftOut(readings, "no point in the band"), 1u);
  EXPECT_TRUE(scan(readings).empty());
  imu.orientation = {0, 0, 0, 1};
  readings.takeImu(toCdr(imu));
  odometry(readings, 2.0);
  readings.takeCloud(0, toCdr(cloudOf(kWalls, {}, at(2.0))));
  EXPECT_EQ(scan(readings), kCross) << "the attitude is of another time: it is not levelled";
  EXPECT_GT(leftOut(readings, "imu: no attitude of a cloud's time"), 0u);
  EXPECT_GT(leftOut(readings, "imu: how it is mounted"), 0u);
}

// Clouds of two lidars and all else may come on threads of their own.
TEST_F(LiveCloudsTest, SeveralThreadsMayTell) {
  LiveReadings::Options wanted = options("odometry");
  wanted.lidars.push_back({"top", {"top", "LRF", "scan"}, {.beams = 16}});
  LiveReadings readings(wanted);
  mount(readings, "lidar", {{0, 0, 0.5}, {}});
  std::vector<std::thread> threads;
  for (const std::size_t lidar : {0, 1, 0})
    threads.emplace_back([&, lidar] {
      for (int i = 0; i < 100; ++i)
        readings.takeCloud(lidar, toCdr(cloudOf(kWalls, {}, at(0.01 * i))));
    });
  for (int i = 0; i < 100; ++i) odometry(readings, 0.01 * i);
  for (std::thread& thread : threads) thread.join();
  std::size_t count = 0;
  while (const auto moment = readings.next(milliseconds(0))) {
    if (moment->readings.empty()) break;
    for (const Message& reading : moment->readings) count += reading.id.type == "LRF" ? 1 : 0;
  }
  EXPECT_EQ(count, 200u);
}

}  // namespace
}  // namespace ortung::ros2

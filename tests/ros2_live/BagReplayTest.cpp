// A bag that is played gives the readings that are in it, word by word, whatever the order in which
// its messages come.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "BagMaker.hpp"
#include "LiveReadings.hpp"
#include "LogTesting.hpp"
#include "ortung/ros2/RobotTopics.hpp"

namespace ortung::ros2 {
namespace {

using namespace ortung::testing;

/// A message in the order of recording.
struct Recorded {
  std::int64_t at = 0;    ///< time of arrival [ns]
  std::size_t which = 0;  ///< 0 odometry, 1 and 2 scanners
  LaserScan scan;
  Odometry odometry;
};

const std::array<std::string, 3> kTopics = {"/odom", "/front/scan", "/rear/scan"};
constexpr double kSeconds = 4.0;

std::vector<float> rangesOf(std::mt19937& random) {
  std::vector<float> ranges(3);
  for (float& range : ranges) range = std::uniform_real_distribution(-0.2F, 9.0F)(random);
  if (random() % 5 == 0) ranges[random() % 3] = std::numeric_limits<float>::quiet_NaN();
  if (random() % 5 == 0) ranges[random() % 3] = std::numeric_limits<float>::infinity();
  return ranges;
}

Odometry movedAt(std::int64_t stamp, std::mt19937& random) {
  std::normal_distribution<double> any;
  Odometry moved = odometryAt(stamp, any(random), any(random));
  moved.pose = fromPose2({10.0 * any(random), any(random), any(random)});
  moved.linear.y = any(random);
  moved.angular.z = any(random);
  return moved;
}

/// Two scanners that are not equally late, and odometry; each begins some time after the other.
std::vector<Recorded> recording(std::mt19937& random) {
  std::vector<Recorded> all;
  const auto jitter = [&](double least, double most) {
    return std::llround(1e9 * std::uniform_real_distribution(least, most)(random));
  };
  const auto begin = static_cast<std::int64_t>(1000 * kSecond);
  for (int i = 0; i < 50 * kSeconds; ++i) {
    const std::int64_t stamp = begin + i * kSecond / 50 + jitter(0.0, 0.004);
    all.push_back({stamp + jitter(0.001, 0.012), 0, {}, movedAt(stamp, random)});
  }
  for (int i = 0; i < 10 * kSeconds; ++i) {
    for (const std::size_t which : {1, 2}) {
      const std::int64_t stamp =
          begin + i * kSecond / 10 + (which == 1 ? 30'000'000 : 80'000'000) + jitter(0.0, 0.008);
      const std::int64_t latency = which == 1 ? jitter(0.005, 0.010) : jitter(0.060, 0.075);
      all.push_back(
          {stamp + latency, which, scanOf(stamp, "base_footprint", rangesOf(random)), {}});
    }
  }
  std::stable_sort(all.begin(), all.end(),
                   [](const Recorded& a, const Recorded& b) { return a.at < b.at; });
  return all;
}

std::vector<Message> fromFile(const std::vector<Recorded>& all) {
  BagMaker maker;
  for (const Recorded& one : all) {
    if (one.which == 0)
      maker.add(kTopics[0], one.odometry);
    else
      maker.add(kTopics[one.which], one.scan);
  }
  const TemporaryFolder folder;
  return readAll("mcap:" + folder.write("run.mcap", maker.bytes()).string());
}

/// What is ready before the next message comes, as an idle robot takes it.
std::vector<Message> played(const std::vector<Recorded>& all, LiveReadings& readings) {
  std::vector<Message> given;
  for (const Recorded& one : all) {
    if (one.which == 0)
      readings.takeOdometry(toCdr(one.odometry));
    else
      readings.takeScan(one.which - 1, toCdr(one.scan));
    for (;;) {
      const auto moment = readings.next(std::chrono::milliseconds(0));
      if (!moment || moment->readings.empty()) break;
      given.insert(given.end(), moment->readings.begin(), moment->readings.end());
    }
  }
  return given;
}

TEST(BagReplay, GivesTheReadingsOfTheFile) {
  std::mt19937 random(11);
  for (int round = 0; round < 10; ++round) {
    const std::vector<Recorded> all = recording(random);
    LiveReadings::Options options;
    options.scanners = {{kTopics[1], {"front_scan", "LRF", "scan"}, 3, 8.1},
                        {kTopics[2], {"rear_scan", "LRF", "scan"}, 3, 8.1}};
    options.odometry = {"odometry", "odometry", "pose"};
    options.patience = std::chrono::milliseconds(600'000);  // on a busy machine, too
    LiveReadings readings(options);
    const std::vector<Message> given = played(all, readings);
    ASSERT_FALSE(given.empty());
    EXPECT_TRUE(readings.leftOut().empty()) << readings.leftOut().begin()->first;
    // The last ones wait for what does not come any more.
    const Timestamp end = given.back().stamp;
    EXPECT_GT(end, static_cast<Timestamp>((1000.0 + kSeconds - 0.3) * 1e6));
    std::vector<Message> expected = fromFile(all);
    std::erase_if(expected, [&](const Message& one) { return one.stamp > end; });
    EXPECT_EQ(asText(given), asText(expected));
  }
}

}  // namespace
}  // namespace ortung::ros2

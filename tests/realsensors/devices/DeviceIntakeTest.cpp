#include <gtest/gtest.h>

#include "ortung/devices/DeviceIntake.hpp"
#include "ortung/formats/OdometryData.hpp"
#include "ortung/formats/ScanData.hpp"

namespace ortung {
namespace {

constexpr Timestamp kSecond = 1'000'000;

struct Intake : testing::Test {
  Intake() : scan({"laser", "LRF", "scan"}, {}, config()), odometry({"o", "odometry", "pose"}) {}
  static ScanData::Config config() {
    ScanData::Config scan;
    scan.beams = 3;
    scan.angleStep = 0.1;
    return scan;
  }
  static DeviceReading scanOf(std::uint32_t range, std::optional<Timestamp> time = std::nullopt) {
    return {0, {range, range, range}, time};
  }
  static DeviceReading wheelsOf(std::optional<Timestamp> time) {
    return {1, OdometryData::encode({}), time};
  }
  ScanData scan;
  OdometryData odometry;
};

using DeviceIntakeTest = Intake;

TEST_F(DeviceIntakeTest, NamesAndStampsReadings) {
  DeviceIntake intake({&scan, &odometry}, {});
  intake.opened(0);
  const auto message = intake.take(scanOf(1000), 5 * kSecond);
  ASSERT_TRUE(message);
  EXPECT_EQ(toText(message->id), "laser/LRF/scan");
  EXPECT_EQ(message->stamp, 5 * kSecond);
  EXPECT_EQ(intake.status(5 * kSecond).state, DeviceState::kRunning);
}

TEST_F(DeviceIntakeTest, RefusesWordsThatTheFeatureDoesNotTake) {
  DeviceIntake intake({&scan}, {});
  intake.opened(0);
  EXPECT_FALSE(intake.take({0, {1, 2}, std::nullopt}, kSecond));
  EXPECT_EQ(intake.status(kSecond).refused, 1U);
  EXPECT_EQ(intake.status(kSecond).readings, 0U);
}

TEST_F(DeviceIntakeTest, RefusesTimesThatNoClockShows) {
  DeviceIntake intake({&odometry}, {});
  intake.opened(0);
  const std::vector<std::uint32_t> words = OdometryData::encode({});
  std::uint64_t refused = 0;
  for (const Timestamp time : {INT64_MIN, INT64_MAX, DeviceClock::kFarthest + 1}) {
    EXPECT_FALSE(intake.take({0, words, time}, kSecond)) << time;
    EXPECT_EQ(intake.status(kSecond).refused, ++refused);
  }
  EXPECT_EQ(intake.take({0, words, kSecond}, 2 * kSecond)->stamp, 2 * kSecond);
}

TEST_F(DeviceIntakeTest, LeavesOutReadingsOfATimeThatItHasHad) {
  DeviceIntake intake({&scan, &odometry}, {});
  intake.opened(0);
  EXPECT_TRUE(intake.take(wheelsOf(100), kSecond));
  EXPECT_TRUE(intake.take(scanOf(1000, 100), kSecond));  // another feature of the same moment
  EXPECT_FALSE(intake.take(wheelsOf(100), 2 * kSecond));
  EXPECT_EQ(intake.status(2 * kSecond).repeated, 1U);
}

TEST_F(DeviceIntakeTest, TellsAFrozenScannerFromARobotAtRest) {
  DeviceIntake::Config config;
  config.repeatsOfFrozen = 5;
  DeviceIntake laser({&scan}, config);
  laser.opened(0);
  std::size_t taken = 0;
  for (Timestamp t = 0; t < 4 * kSecond; t += kSecond / 10)
    taken += laser.take(scanOf(700), t) ? 1 : 0;
  EXPECT_EQ(taken, 5U);
  EXPECT_EQ(laser.status(4 * kSecond).state, DeviceState::kFrozen);
  EXPECT_NE(laser.status(4 * kSecond).reason.find("the same reading for"), std::string::npos);
  EXPECT_TRUE(laser.take(scanOf(701), 4 * kSecond));
  EXPECT_EQ(laser.status(4 * kSecond).state, DeviceState::kRunning);

  DeviceIntake wheels({&scan, &odometry}, {});  // odometry: never
  wheels.opened(0);
  for (Timestamp t = 0; t < 4 * kSecond; t += kSecond / 10)
    EXPECT_TRUE(wheels.take(wheelsOf(t), t));
}

TEST_F(DeviceIntakeTest, TakesNoMoreOfAFloodThanItMay) {
  DeviceIntake::Config config;
  config.mostPerSecond = 50;
  DeviceIntake intake({&scan}, config);
  intake.opened(0);
  std::vector<Timestamp> taken;
  for (Timestamp t = 0; t < 3 * kSecond; t += 100)
    if (intake.take(scanOf(static_cast<std::uint32_t>(t)), t)) taken.push_back(t);
  // Half a second's worth at once, then one each 20 ms.
  EXPECT_NEAR(static_cast<double>(taken.size()), 25.0 + 150.0, 1.0);
  EXPECT_EQ(intake.status(3 * kSecond).flooded, 30'000U - taken.size());
  for (std::size_t i = 26; i < taken.size(); ++i)
    EXPECT_NEAR(static_cast<double>(taken[i] - taken[i - 1]), 20'000.0, 100.0);
  EXPECT_TRUE(intake.take(scanOf(1), 3 * kSecond + 50'000)) << "nothing is missing after it";
}

TEST_F(DeviceIntakeTest, StampsGoOnRisingWhenADeviceWithANewClockComesBack) {
  DeviceIntake intake({&odometry}, {});
  intake.opened(0);
  const auto wheels = [](Timestamp time) {
    return DeviceReading{0, OdometryData::encode({}), time};
  };
  const auto first = intake.take(wheels(900 * kSecond), 10 * kSecond);
  intake.opened(20 * kSecond);
  const auto second = intake.take(wheels(kSecond), 21 * kSecond);
  ASSERT_TRUE(first && second);
  EXPECT_EQ(second->stamp, 21 * kSecond);
  EXPECT_EQ(intake.status(21 * kSecond).clockJumps, 0U);
}

TEST(DeviceHealth, GoesFromOpeningToRunningToStaleAndIsGivenUp) {
  DeviceHealth health({.staleAfter = 1.0, .reopenAfter = 5.0});
  EXPECT_EQ(health.state(0), DeviceState::kOpening);
  EXPECT_TRUE(health.mayOpen(0));
  health.opened(0);
  EXPECT_EQ(health.state(kSecond / 2), DeviceState::kOpening);
  health.tookReading(kSecond);
  EXPECT_EQ(health.state(2 * kSecond), DeviceState::kRunning);
  EXPECT_EQ(health.state(2 * kSecond + 1), DeviceState::kStale);
  EXPECT_EQ(health.status(3 * kSecond).reason, "no reading for 2.0 s");
  EXPECT_DOUBLE_EQ(*health.status(3 * kSecond).age, 2.0);
  EXPECT_FALSE(health.mustClose(6 * kSecond));
  EXPECT_TRUE(health.mustClose(6 * kSecond + 1));
}

TEST(DeviceHealth, TriesAgainALittleLaterEachTime) {
  DeviceHealth health({.openAfter = 0.5, .openAfterMost = 4.0});
  Timestamp now = 0;
  std::vector<double> waits;
  for (int i = 0; i < 6; ++i) {
    health.closed(now, false, "no such device");
    waits.push_back(toSeconds(health.nextTry() - now));
    EXPECT_FALSE(health.mayOpen(health.nextTry() - 1));
    now = health.nextTry();
    EXPECT_TRUE(health.mayOpen(now));
  }
  EXPECT_EQ(waits, (std::vector<double>{0.5, 1.0, 2.0, 4.0, 4.0, 4.0}));
  health.closed(now, true, "other beams");  // which seldom changes by itself
  EXPECT_EQ(toSeconds(health.nextTry() - now), 8.0);
  health.closed(now, false, "no such device");
  EXPECT_EQ(health.state(now), DeviceState::kAbsent);
  EXPECT_EQ(health.status(now).reason, "no such device");
  health.opened(now);
  health.tookReading(now);
  health.closed(now, true, "other beams");
  EXPECT_EQ(health.state(now), DeviceState::kFailed);
  EXPECT_EQ(toSeconds(health.nextTry() - now), 0.5);  // it has run meanwhile
}

TEST(DeviceHealth, CountsTheRateOfTheLastTwoSeconds) {
  DeviceHealth health({});
  health.opened(0);
  for (Timestamp t = 0; t < 10 * kSecond; t += kSecond / 20) health.tookReading(t);
  EXPECT_DOUBLE_EQ(health.status(10 * kSecond - 1).rate, 20.0);
  EXPECT_DOUBLE_EQ(health.status(11 * kSecond).rate, 9.5);
  EXPECT_DOUBLE_EQ(health.status(13 * kSecond).rate, 0.0);
}

}  // namespace
}  // namespace ortung

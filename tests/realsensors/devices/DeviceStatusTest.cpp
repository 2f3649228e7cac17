/// The status of a device: its words for clients, and the finer points of its health.
#include <gtest/gtest.h>

#include "ortung/devices/DeviceIntake.hpp"
#include "ortung/devices/DeviceStatusData.hpp"
#include "ortung/formats/OdometryData.hpp"

namespace ortung {
namespace {

constexpr Timestamp kSecond = 1'000'000;

TEST(DeviceStatusData, HasAWordForEachNumber) {
  const SensorId id = DeviceStatusData::idOf(2, "lines");
  EXPECT_EQ(toText(id), "device/status/lines2");
  DeviceStatus status;
  status.state = DeviceState::kStale;
  status.readings = 11;
  status.rate = 12.3456;
  status.age = 0.0125;
  status.openings = 99;  // is not in the words
  status.refused = 13;
  status.repeated = 14;
  status.flooded = 15;
  status.late = 16;
  status.clockJumps = 17;
  const Message message = DeviceStatusData::message(id, 5 * kSecond, status);
  EXPECT_EQ(message.stamp, 5 * kSecond);
  EXPECT_EQ(message.id, id);
  EXPECT_EQ(message.words, (std::vector<std::uint32_t>{3, 11, 12346, 13, 13, 14, 15, 16, 17}));
  DeviceStatusData data(2, "lines");
  EXPECT_EQ(data.id(), id);
  EXPECT_NO_THROW(data.checkData(message.words));
}

TEST(DeviceStatusData, NumbersThatAreTooLargeStayAtTheGreatestWord) {
  DeviceStatus status;
  status.readings = std::uint64_t{1} << 40;
  status.late = 4294967295U;
  status.rate = 1e9;
  const auto words = DeviceStatusData::message(DeviceStatusData::idOf(0, "x"), 0, status).words;
  EXPECT_EQ(words[0], 0u);
  EXPECT_EQ(words[1], 4294967295U);
  EXPECT_EQ(words[2], 4'000'000'000U);
  EXPECT_EQ(words[3], 4294967295U) << "no reading has an age";
  EXPECT_EQ(words[7], 4294967295U);
}

TEST(DeviceStatusData, RefusesOtherWords) {
  const DeviceStatusData data(0, "x");
  std::vector<std::uint32_t> words(9, 5);
  EXPECT_NO_THROW(data.checkData(words));
  words[0] = 7;
  EXPECT_THROW(data.checkData(words), std::invalid_argument);
  words.assign(8, 0);
  EXPECT_THROW(data.checkData(words), std::invalid_argument);
  words.assign(10, 0);
  EXPECT_THROW(data.checkData(words), std::invalid_argument);
}

TEST(DeviceStatusData, ItsFormatNamesTheStates) {
  EXPECT_EQ(DeviceStatusData(0, "x").format().list("status"),
            (std::vector<std::string>{"opening", "absent", "running", "stale", "frozen", "failed",
                                      "late"}));
}

TEST(DeviceHealth, AReopenedDeviceHasNotMeasuredYet) {
  DeviceHealth health({.staleAfter = 1.0});
  health.opened(0);
  health.tookReading(kSecond);
  health.closed(2 * kSecond, false, "pulled");
  EXPECT_FALSE(health.isOpen());
  EXPECT_EQ(health.state(2 * kSecond), DeviceState::kAbsent);
  EXPECT_EQ(health.status(2 * kSecond).reason, "pulled");
  health.opened(3 * kSecond);
  EXPECT_TRUE(health.isOpen());
  EXPECT_FALSE(health.mayOpen(100 * kSecond)) << "it is open";
  EXPECT_EQ(health.state(4 * kSecond), DeviceState::kOpening);
  EXPECT_EQ(health.status(4 * kSecond).reason, "pulled") << "it is kept until it runs again";
  health.tookReading(4 * kSecond);
  EXPECT_EQ(health.state(4 * kSecond), DeviceState::kRunning);
  EXPECT_EQ(health.status(4 * kSecond).reason, "");
  EXPECT_EQ(health.status(4 * kSecond).openings, 2u);
  EXPECT_EQ(health.status(4 * kSecond).readings, 2u);
}

TEST(DeviceHealth, ADeviceThatNeverMeasuresIsStaleThenClosed) {
  DeviceHealth health({.staleAfter = 1.0, .reopenAfter = 3.0});
  EXPECT_FALSE(health.mustClose(100 * kSecond)) << "it is not open";
  health.opened(10 * kSecond);
  EXPECT_EQ(health.state(11 * kSecond), DeviceState::kOpening);
  EXPECT_EQ(health.state(11 * kSecond + 1), DeviceState::kStale);
  EXPECT_FALSE(health.status(12 * kSecond).age);
  EXPECT_FALSE(health.mustClose(13 * kSecond));
  EXPECT_TRUE(health.mustClose(13 * kSecond + 1));
}

// A device that repeats its reading is there: it is frozen, and not opened anew.
TEST(DeviceHealth, RepeatsAreASignOfLife) {
  DeviceHealth health({.staleAfter = 1.0, .reopenAfter = 3.0});
  health.opened(0);
  health.tookReading(0);
  for (Timestamp t = 0; t <= 10 * kSecond; t += kSecond) health.sawRepeat(t);
  EXPECT_EQ(health.state(10 * kSecond), DeviceState::kFrozen);
  EXPECT_EQ(health.status(10 * kSecond).reason, "the same reading for 10.0 s");
  EXPECT_FALSE(health.mustClose(13 * kSecond));
  EXPECT_TRUE(health.mustClose(13 * kSecond + 1));
  health.tookReading(14 * kSecond);
  EXPECT_EQ(health.state(16 * kSecond), DeviceState::kStale) << "a new reading, then silence";
}

TEST(DeviceHealth, HasFailedAsLongAsItDoesNotFit) {
  DeviceHealth health({});
  health.opened(0);
  health.closed(0, true, "other beams");
  EXPECT_EQ(health.state(0), DeviceState::kFailed);
  health.closed(0, false, "gone");
  EXPECT_EQ(health.state(0), DeviceState::kAbsent);
}

TEST(DeviceStates, HaveAWordEach) {
  for (const auto& [state, word] : {std::pair{DeviceState::kOpening, "opening"},
                                    {DeviceState::kAbsent, "absent"},
                                    {DeviceState::kRunning, "running"},
                                    {DeviceState::kStale, "stale"},
                                    {DeviceState::kFrozen, "frozen"},
                                    {DeviceState::kFailed, "failed"},
                                    {DeviceState::kLate, "late"}})
    EXPECT_STREQ(toText(state), word);
}

// A feature that the device does not have is a fault of its driver.
TEST(DeviceIntakeLimits, RefuseFeaturesThatAreNotThere) {
  const OdometryData odometry({"o", "odometry", "pose"});
  DeviceIntake intake({&odometry}, {});
  intake.opened(0);
  EXPECT_THROW(intake.take({1, OdometryData::encode({}), std::nullopt}, 0), std::invalid_argument);
  EXPECT_FALSE(intake.status(0).driftPpm);
  EXPECT_TRUE(intake.take({0, OdometryData::encode({}), 70}, kSecond));
  EXPECT_TRUE(intake.status(kSecond).driftPpm) << "it has a clock";
}

// At most one at once here, and two a second; what one second does not use is not added to the
// next.
TEST(DeviceIntakeLimits, EachSecondHasItsReadings) {
  const OdometryData odometry({"o", "odometry", "pose"});
  DeviceIntake::Config config;
  config.mostPerSecond = 2;
  DeviceIntake intake({&odometry}, config);
  intake.opened(0);
  std::string taken;
  for (const Timestamp t :
       {1'500'000, 1'600'000, 1'700'000, 2'250'000, 2'500'000, 2'800'000, 9'000'000, 9'100'000})
    taken += intake.take({0, OdometryData::encode({}), std::nullopt}, t) ? '+' : '-';
  EXPECT_EQ(taken, "+--+-++-");
  EXPECT_EQ(intake.status(9 * kSecond).flooded, 4u);
}

}  // namespace
}  // namespace ortung

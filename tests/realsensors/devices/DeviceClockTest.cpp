#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "ortung/base/Random.hpp"
#include "ortung/devices/DeviceClock.hpp"

namespace ortung {
namespace {

constexpr Timestamp kMillisecond = 1000;
constexpr Timestamp kSecond = 1'000'000;

TEST(DeviceClock, FindsTheOffsetOfADeviceBelowItsDelays) {
  DeviceClock clock;
  Random random(1);
  constexpr Timestamp kOffset = 5'000'000'000;
  constexpr Timestamp kLeast = 2 * kMillisecond;
  Timestamp error = 0;
  for (Timestamp t = 0; t < 60 * kSecond; t += 50 * kMillisecond) {
    // Exponential delays with a mean of 8 ms above the least, now and then a stall of 200 ms.
    double delay = -8e3 * std::log(1.0 - random.uniform());
    if (random.uniform() < 0.02) delay += 2e5;
    const Timestamp truth = t + kOffset;
    const Timestamp stamp = *clock.toHost(t, truth + kLeast + static_cast<Timestamp>(delay));
    if (t > 10 * kSecond) error = std::max(error, std::abs(stamp - (truth + kLeast)));
  }
  // Of 20 delays a second, the shortest in 10 s is below 8 ms / 200 = 40 us in the mean.
  EXPECT_LT(error, kMillisecond);
  EXPECT_EQ(clock.jumps(), 0U);
}

TEST(DeviceClock, FollowsAClockThatDrifts) {
  for (const double ppm : {-80.0, 80.0}) {
    DeviceClock clock;
    Random random(2);
    Timestamp error = 0;
    for (Timestamp t = 0; t < 300 * kSecond; t += 100 * kMillisecond) {
      const auto device = static_cast<Timestamp>(static_cast<double>(t) * (1.0 + ppm * 1e-6));
      const auto delay = static_cast<Timestamp>(3000.0 * random.uniform());
      const Timestamp stamp = *clock.toHost(device, t + delay);
      if (t > 60 * kSecond) error = std::max(error, std::abs(stamp - t));
    }
    EXPECT_LT(error, kMillisecond) << ppm;  // an offset alone would be off by 24 ms at the end
    EXPECT_NEAR(clock.driftPpm(), ppm, 10.0);
  }
}

TEST(DeviceClock, NeverRunsBackwardsAndNeverAhead) {
  DeviceClock clock;
  Random random(3);
  Timestamp last = -1;
  for (Timestamp t = 0; t < 100 * kSecond; t += 20 * kMillisecond) {
    const auto device = t + static_cast<Timestamp>(random.uniform(-3000.0, 3000.0));
    const Timestamp arrival = t + kSecond + static_cast<Timestamp>(random.uniform(0.0, 50'000.0));
    const Timestamp stamp = *clock.toHost(device, arrival);
    EXPECT_GT(stamp, last);
    EXPECT_LE(stamp, std::max(arrival, last + 1));
    last = stamp;
  }
}

TEST(DeviceClock, GivesReadingsOfOneDeviceTimeOneStamp) {
  DeviceClock clock;
  const Timestamp stamp = *clock.toHost(70 * kSecond, kSecond);
  EXPECT_EQ(clock.toHost(70 * kSecond, kSecond + 700), stamp);
  EXPECT_GT(*clock.toHost(70 * kSecond + 1, kSecond + 700), stamp);
}

/// A device that measures ten times a second, whose clock is set by @p jump after 20 s.
/// Returns the largest error of stamps [us]; readings may be late for 3 s behind the jump.
Timestamp errorAfter(Timestamp jump, std::uint64_t& jumps) {
  DeviceClock clock;
  Timestamp error = 0;
  for (Timestamp t = 0; t < 40 * kSecond; t += 100 * kMillisecond) {
    const Timestamp device = t + (t >= 20 * kSecond ? jump : 0);
    const auto stamp = clock.toHost(device, t + kMillisecond);
    EXPECT_TRUE(stamp || t < 23 * kSecond) << t;
    if (stamp) error = std::max(error, std::abs(*stamp - (t + kMillisecond)));
  }
  jumps = clock.jumps();
  return error;
}

TEST(DeviceClock, NoticesAClockThatWasSetAndStartsOver) {
  for (const Timestamp jump : {3600 * kSecond, -3600 * kSecond, 2 * kSecond, -2 * kSecond}) {
    std::uint64_t jumps = 0;
    EXPECT_LT(errorAfter(jump, jumps), kMillisecond) << jump;
    EXPECT_EQ(jumps, 1U) << jump;
  }
}

TEST(DeviceClock, TakesAStallOfTheLineForNoJump) {
  DeviceClock clock;
  for (Timestamp t = 0; t < 30 * kSecond; t += 100 * kMillisecond) {
    // From second 10 on nothing comes for 1.5 s, then all of it at once.
    const bool isHeldUp = t >= 10 * kSecond && t < 10 * kSecond + 1500 * kMillisecond;
    const Timestamp arrival = isHeldUp ? 10 * kSecond + 1500 * kMillisecond : t;
    const auto stamp = clock.toHost(t, arrival);
    EXPECT_EQ(stamp.has_value(), arrival - t <= 500 * kMillisecond) << t;
    EXPECT_NEAR(static_cast<double>(stamp.value_or(t) - t), 0.0, 10.0);
  }
  EXPECT_EQ(clock.jumps(), 0U);
}

TEST(DeviceClock, StampsADeviceWithoutAClockByItsArrivalLessTheLatency) {
  DeviceClock clock({.latency = 0.04});
  EXPECT_EQ(clock.toHost(kSecond), kSecond - 40 * kMillisecond);
  EXPECT_EQ(clock.toHost(kSecond), kSecond - 40 * kMillisecond + 1);  // later than the last one
}

TEST(DeviceClock, StampsADeviceWithAClockEarlierByTheLatencyWhateverItsClock) {
  DeviceClock clock({.latency = 0.04});
  for (Timestamp t = 0; t < 30 * kSecond; t += 100 * kMillisecond)  // every reading is 40 ms late
    EXPECT_EQ(clock.toHost(t + 1'000 * kSecond, t + 40 * kMillisecond), t);
}

TEST(DeviceClock, LivesWithTheClocksOfHostileDevices) {
  DeviceClock clock;
  Timestamp last = -1;
  Timestamp arrival = 0;
  for (const Timestamp device : {INT64_MIN, INT64_MAX, Timestamp{0}, INT64_MAX, INT64_MIN + 1}) {
    arrival += kSecond;
    const auto stamp = clock.toHost(device, arrival);
    if (!stamp) continue;
    EXPECT_GT(*stamp, last);
    EXPECT_LE(*stamp, arrival);
    last = *stamp;
  }
}

/// Stamps of a device whose clock shows, at each arrival, what @p device says; ten a second.
/// Returns the greatest age of a stamp [us]; a reading without one is not used.
template <class Device>
Timestamp greatestAge(const Device& device) {
  DeviceClock clock;
  Timestamp age = 0;
  Timestamp last = -1;
  for (Timestamp arrival = 0; arrival < 120 * kSecond; arrival += 100 * kMillisecond) {
    const auto stamp = clock.toHost(device(arrival), arrival);
    if (!stamp) continue;
    EXPECT_GE(*stamp, last);
    EXPECT_LE(*stamp, arrival);
    age = std::max(age, arrival - *stamp);
    last = *stamp;
  }
  return age;
}

TEST(DeviceClock, StaysNearTheHostsTimeWhateverTheDeviceShows) {
  constexpr Timestamp kHour = 3600 * kSecond;
  constexpr Timestamp kLongest = 500 * kMillisecond;
  const auto backAndForth = [](Timestamp t) { return t + (t / kSecond % 2) * 5 * kHour; };
  EXPECT_LT(greatestAge(backAndForth), 100 * kMillisecond);
  EXPECT_LE(greatestAge([](Timestamp) { return kHour; }), kLongest);
  EXPECT_LE(greatestAge([](Timestamp t) { return INT64_MAX - 1 + t * 0; }), kLongest);
  EXPECT_LE(greatestAge([](Timestamp t) { return INT64_MIN + t; }), kLongest);
  EXPECT_LE(greatestAge([](Timestamp t) { return t / 100; }), kLongest);
  EXPECT_LE(greatestAge([](Timestamp t) { return 3 * t; }), kLongest);
}

TEST(DeviceClock, GoesOnAtTheHostsTimeAfterItStoodStill) {
  DeviceClock clock;
  EXPECT_EQ(clock.toHost(70 * kSecond, kSecond), kSecond);
  // An hour later the device's clock is where it was: it may have been off, or the line was.
  const auto later = [&](Timestamp t) {
    return clock.toHost(70 * kSecond + t, 3601 * kSecond + t);
  };
  Timestamp t = 100;
  while (!later(t) && t < 10 * kSecond) t += 100 * kMillisecond;
  EXPECT_NEAR(toSeconds(t), 2.0, 0.2);  // a stall would have come to its end by then
  EXPECT_EQ(clock.jumps(), 1U);
  t += kSecond;
  EXPECT_EQ(later(t), 3601 * kSecond + t);
}

}  // namespace
}  // namespace ortung

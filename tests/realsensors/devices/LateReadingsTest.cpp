/// Readings that were held up, by devices of whose lines everything is known: when each reading was
/// measured, and when it arrives.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "ortung/base/Random.hpp"
#include "ortung/devices/DeviceClock.hpp"
#include "ortung/devices/DeviceIntake.hpp"
#include "ortung/formats/OdometryData.hpp"

namespace ortung {
namespace {

constexpr Timestamp kMillisecond = 1000;
constexpr Timestamp kSecond = 1'000'000;
constexpr Timestamp kAhead = 4000 * kSecond;  ///< of the device's clock, that nobody is told

/// One reading: when it was measured and when it arrives, by the host's clock.
struct Sent {
  Timestamp measured;
  Timestamp arrival;
};

/// A line that carries one reading in @p each, in their order.
std::vector<Sent> queued(const std::vector<Timestamp>& measured, Timestamp each) {
  std::vector<Sent> sent;
  Timestamp free = 0;
  for (const Timestamp t : measured) {
    free = std::max(free, t) + each;
    sent.push_back({t, free});
  }
  return sent;
}

std::vector<Timestamp> regular(Timestamp from, Timestamp to, Timestamp period) {
  std::vector<Timestamp> times;
  for (Timestamp t = from; t < to; t += period) times.push_back(t);
  return times;
}

void append(std::vector<Timestamp>& times, const std::vector<Timestamp>& more) {
  times.insert(times.end(), more.begin(), more.end());
}

/// What became of a device's readings.
struct Outcome {
  std::uint64_t jumps = 0;
  Timestamp worst = 0;     ///< greatest error of a stamp [us]
  Timestamp oldest = 0;    ///< greatest age of a reading that was used, when it arrived [us]
  Timestamp lastLate = 0;  ///< arrival of the last one that was not
  std::size_t late = 0;
};

Outcome outcomeOf(const std::vector<Sent>& sent) {
  DeviceClock clock;
  Outcome outcome;
  for (const Sent& one : sent) {
    const auto stamp = clock.toHost(one.measured + kAhead, one.arrival);
    if (stamp) {
      outcome.worst = std::max(outcome.worst, std::abs(*stamp - one.measured));
      outcome.oldest = std::max(outcome.oldest, one.arrival - one.measured);
    } else {
      outcome.lastLate = one.arrival;
      ++outcome.late;
    }
  }
  outcome.jumps = clock.jumps();
  return outcome;
}

// A flood of one second leaves a queue that the line needs 34 s for: readings that were measured
// meanwhile are all in it.
TEST(LateReadings, OfAQueueAfterAFloodAreNotUsedAndNoClockWasSet) {
  std::vector<Timestamp> measured = regular(0, 10 * kSecond, 50 * kMillisecond);
  append(measured, regular(10 * kSecond, 11 * kSecond, 117));  // 8547 readings
  append(measured, regular(11 * kSecond, 120 * kSecond, 50 * kMillisecond));
  const Outcome outcome = outcomeOf(queued(measured, 4 * kMillisecond));
  EXPECT_EQ(outcome.jumps, 0U);
  EXPECT_LE(outcome.oldest, 510 * kMillisecond);
  EXPECT_LE(outcome.worst, 15 * kMillisecond);
  // 8547 * 4 ms of work came in 1 s; 20 readings a second leave 92 % of the line for it. The last
  // ones that are late come half a second after they were measured.
  EXPECT_NEAR(toSeconds(outcome.lastLate), 10.0 + (8547 * 0.004 - 0.5) / 0.92 + 0.5, 0.2);
}

// The same with a device that keeps no more than 50 readings: its queue is full as long as it is
// flooded, and all readings are late by the same time.
TEST(LateReadings, OfAFullQueueAreLateAsLongAsItIsFull) {
  constexpr Timestamp kEach = 20 * kMillisecond;
  std::vector<Sent> sent;
  Timestamp free = 0;
  for (Timestamp t = 0; t < 60 * kSecond;
       t += t >= 10 * kSecond && t < 20 * kSecond ? kMillisecond : 50 * kMillisecond) {
    if (free - t > 50 * kEach) continue;
    free = std::max(free, t) + kEach;
    sent.push_back({t, free});
  }
  const Outcome outcome = outcomeOf(sent);
  EXPECT_EQ(outcome.jumps, 0U);
  EXPECT_LE(outcome.oldest, 530 * kMillisecond);
  EXPECT_LE(outcome.worst, 25 * kMillisecond);
  // A second's worth waits at 20 s, and 20 readings a second leave 60 % of the line for it.
  EXPECT_NEAR(toSeconds(outcome.lastLate), 20.0 + 0.5 / 0.6 + 0.5, 0.1);
}

TEST(LateReadings, ThatAreSentAllAtOnceAreNotUsed) {
  std::vector<Sent> sent;
  for (Timestamp t = 0; t < 60 * kSecond; t += 50 * kMillisecond) {
    const bool isHeld = t >= 20 * kSecond && t < 28 * kSecond;
    sent.push_back({t, isHeld ? 28 * kSecond + (t - 20 * kSecond) / 1000 : t + kMillisecond});
  }
  std::stable_sort(sent.begin(), sent.end(),
                   [](const Sent& a, const Sent& b) { return a.arrival < b.arrival; });
  const Outcome outcome = outcomeOf(sent);
  EXPECT_EQ(outcome.jumps, 0U);
  EXPECT_LE(outcome.worst, 52 * kMillisecond);                 // 50 ms are no disorder
  EXPECT_NEAR(static_cast<double>(outcome.late), 159.0, 1.0);  // of 160: a later one came first
}

// Old readings once more: their times are less than those before.
TEST(LateReadings, ThatAreRepeatedFromLongAgoAreNotUsed) {
  std::vector<Sent> sent;
  for (Timestamp t = 0; t < 40 * kSecond; t += 50 * kMillisecond) {
    sent.push_back({t, t + kMillisecond});
    if (t != 30 * kSecond) continue;
    for (Timestamp old = 0; old < t; old += 50 * kMillisecond)
      sent.push_back({old, t + 2 * kMillisecond + old / 1000});
  }
  const Outcome outcome = outcomeOf(sent);
  EXPECT_EQ(outcome.jumps, 0U);
  EXPECT_LE(outcome.oldest, 510 * kMillisecond);
  EXPECT_LE(outcome.worst, 52 * kMillisecond);  // 50 ms are no disorder
  EXPECT_LE(outcome.lastLate, 30'100 * kMillisecond);
}

// Nobody knows yet how late readings may be when the first ones come out of a queue. They are
// recognised once the delay has fallen by half a second.
TEST(LateReadings, ThatWaitedBeforeTheDeviceWasOpenedAreFoundOut) {
  std::vector<Sent> sent;
  for (Timestamp t = 0; t < 40 * kSecond; t += 50 * kMillisecond)
    sent.push_back({t, std::max(10 * kSecond + t / 20, t + kMillisecond)});
  DeviceClock clock;
  Timestamp worst = 0;
  std::size_t early = 0;
  for (const Sent& one : sent) {
    const auto stamp = clock.toHost(one.measured + kAhead, one.arrival);
    if (one.measured < 9 * kSecond)
      early += stamp ? 1 : 0;
    else if (stamp)
      worst = std::max(worst, std::abs(*stamp - one.measured));
  }
  EXPECT_LE(early, 12U);  // of 180
  EXPECT_LE(worst, 50 * kMillisecond);
  EXPECT_EQ(clock.jumps(), 0U);
}

/// Readings of a clock that is set back at 20 s, over a line with exponential delays.
std::vector<Sent> setBack(Timestamp by, Timestamp period, double meanDelay, std::uint64_t seed) {
  Random random(seed);
  std::vector<Sent> sent;
  Timestamp free = 0;
  for (Timestamp t = 0; t < 60 * kSecond; t += period) {
    const double delay = -1e6 * meanDelay * std::log(1.0 - random.uniform());
    free = std::max(free, t + static_cast<Timestamp>(delay));
    sent.push_back({t >= 20 * kSecond ? t - by : t, free});
  }
  return sent;
}

TEST(LateReadings, OfAClockThatWasSetBackAreUsedOnceThatIsKnown) {
  struct Case {
    Timestamp by;
    Timestamp period;
    double meanDelay;
    double longest;  // [s]
  };
  for (const Case& one : {Case{kSecond, 50 * kMillisecond, 0.002, 1.0},
                          Case{3600 * kSecond, 50 * kMillisecond, 0.01, 2.0},
                          Case{3 * kSecond, 100 * kMillisecond, 0.03, 8.0},
                          Case{700 * kMillisecond, kSecond, 0.001, 6.0}}) {
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
      const Outcome outcome = outcomeOf(setBack(one.by, one.period, one.meanDelay, seed));
      EXPECT_EQ(outcome.jumps, 1U) << toSeconds(one.by);
      EXPECT_GT(outcome.lastLate, 20 * kSecond);
      EXPECT_LT(toSeconds(outcome.lastLate), 20.0 + one.longest) << toSeconds(one.by);
    }
  }
}

// Whatever else a line does for a minute, it must neither be taken for a clock nor poison one.
TEST(LateReadings, OfRandomQueuesAreNeverUsed) {
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    Random random(seed);
    std::vector<Timestamp> measured = regular(0, 10 * kSecond, 50 * kMillisecond);
    Timestamp t = 10 * kSecond;
    while (t < 60 * kSecond) {  // spells of rest and of floods of all strengths
      const auto end = t + static_cast<Timestamp>(random.uniform(0.1e6, 4e6));
      const auto period = static_cast<Timestamp>(
          random.uniform() < 0.5 ? random.uniform(400.0, 4000.0) : random.uniform(4e3, 200e3));
      append(measured, regular(t, end, period));
      t = end;
    }
    append(measured, regular(t, t + 30 * kSecond, 50 * kMillisecond));
    const Outcome outcome = outcomeOf(queued(measured, 3 * kMillisecond));
    EXPECT_EQ(outcome.jumps, 0U) << seed;
    EXPECT_LE(outcome.oldest, 510 * kMillisecond) << seed;
    // Hardly any reading comes at once: a drift of 1000 ppm would fit the delays of a minute, too.
    EXPECT_LE(outcome.worst, 100 * kMillisecond) << seed;
  }
}

TEST(LateReadings, AreCountedAndTheDeviceIsOfNoUseMeanwhile) {
  const OdometryData odometry({"o", "odometry", "pose"});
  DeviceIntake intake({&odometry}, {});
  intake.opened(0);
  const auto take = [&](Timestamp measured, Timestamp arrival) {
    return intake.take({0, OdometryData::encode({}), measured}, arrival).has_value();
  };
  for (Timestamp t = 0; t < 5 * kSecond; t += 50 * kMillisecond) EXPECT_TRUE(take(t, t));
  Timestamp now = 5 * kSecond;
  for (Timestamp t = now; now < 8 * kSecond; t += 10 * kMillisecond, now += 50 * kMillisecond)
    take(t, now);
  DeviceStatus status = intake.status(now);
  EXPECT_EQ(status.state, DeviceState::kLate);
  EXPECT_EQ(status.reason, "its readings are 2.4 s old when they arrive");  // 59 * 40 ms
  EXPECT_GT(status.late, 40U);
  EXPECT_EQ(status.clockJumps, 0U);
  EXPECT_GT(*status.age, 2.0);
  EXPECT_TRUE(take(now, now));
  status = intake.status(now);
  EXPECT_EQ(status.state, DeviceState::kRunning);
  EXPECT_EQ(status.reason, "");
}

TEST(LateReadings, LeadToARefreshWhichIsRepeatedLessAndLess) {
  DeviceHealth health({.refreshAfter = 0.5, .refreshAfterMost = 2.0});
  health.opened(0);
  health.tookReading(0);
  std::vector<double> refreshes;
  for (Timestamp t = kSecond; t < 9 * kSecond; t += 10 * kMillisecond) {
    health.sawLate(t, 1.0);
    EXPECT_FALSE(health.mustClose(t)) << "it is there";
    if (!health.mustRefresh(t)) continue;
    refreshes.push_back(toSeconds(t));
    health.refreshed(t);
  }
  EXPECT_EQ(refreshes, (std::vector<double>{1.5, 2.5, 4.5, 6.5, 8.5}));
  health.tookReading(9 * kSecond);
  EXPECT_FALSE(health.mustRefresh(20 * kSecond));
  health.sawLate(20 * kSecond, std::nullopt);
  EXPECT_EQ(health.status(20 * kSecond).reason, "its readings were held up, and come all at once");
  EXPECT_EQ(health.state(22 * kSecond), DeviceState::kStale) << "then it is silent";
}

// The clock restarts with the device, or runs on while readings of before wait.
TEST(LateReadings, AreFoundAfterTheDeviceWasOpenedAnew) {
  DeviceClock clock;
  for (Timestamp t = 0; t < 20 * kSecond; t += 50 * kMillisecond)
    EXPECT_TRUE(clock.toHost(t + kAhead, t));
  clock.restart();
  EXPECT_FALSE(clock.toHost(21 * kSecond + kAhead, 30 * kSecond)) << "it has waited for 9 s";
  EXPECT_EQ(clock.toHost(30 * kSecond + kAhead, 30 * kSecond), 30 * kSecond);
  clock.restart();
  EXPECT_EQ(clock.toHost(0, 31 * kSecond), 31 * kSecond) << "another clock";
  EXPECT_EQ(clock.jumps(), 0U);
}

TEST(LateReadings, ADriftBeyondTheGreatestIsSaid) {
  for (const double ppm : {-3000.0, -900.0, 0.0, 900.0, 3000.0}) {
    DeviceClock clock;
    Timestamp late = 0;
    for (Timestamp t = 0; t < 120 * kSecond; t += 50 * kMillisecond) {
      const auto device = static_cast<Timestamp>(static_cast<double>(t) * (1.0 + ppm * 1e-6));
      if (!clock.toHost(device, t)) ++late;
    }
    EXPECT_EQ(clock.driftsTooMuch(), std::abs(ppm) > 1000.0) << ppm;
    EXPECT_NEAR(clock.driftPpm(), std::clamp(ppm, -1000.0, 1000.0), 5.0);
    EXPECT_EQ(late, 0);
  }
}

}  // namespace
}  // namespace ortung

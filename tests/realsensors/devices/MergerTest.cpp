#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "ortung/base/Random.hpp"
#include "ortung/devices/Merger.hpp"

namespace ortung {
namespace {

constexpr Timestamp kMillisecond = 1000;

Message reading(Timestamp stamp, const std::string& feature) {
  return {stamp, {"m", "t", feature}, {1}};
}

std::vector<Timestamp> stampsAt(Merger& merger, Timestamp now) {
  std::vector<Timestamp> stamps;
  while (const auto message = merger.pop(now)) stamps.push_back(message->stamp);
  return stamps;
}

TEST(Merger, PassesOnWhatNobodyCanPrecedeAnyMore) {
  Merger merger(2, 0.05);
  merger.await(0, true);
  merger.await(1, true);
  merger.push(1, reading(10, "b"));
  merger.push(0, reading(20, "a"));
  EXPECT_EQ(stampsAt(merger, 21), (std::vector<Timestamp>{10}));  // b may still give 15
  merger.push(1, reading(15, "b"));
  EXPECT_EQ(stampsAt(merger, 22), (std::vector<Timestamp>{15}));
  merger.push(1, reading(30, "b"));
  EXPECT_EQ(stampsAt(merger, 31), (std::vector<Timestamp>{20}));
}

TEST(Merger, WaitsNoLongerThanItIsTold) {
  Merger merger(2, 0.05);
  merger.await(0, true);
  merger.await(1, true);
  merger.push(1, reading(0, "b"));
  EXPECT_EQ(stampsAt(merger, 1), (std::vector<Timestamp>{0}));
  merger.push(0, reading(100 * kMillisecond, "a"));
  EXPECT_EQ(merger.due(), 150 * kMillisecond);
  EXPECT_TRUE(stampsAt(merger, 150 * kMillisecond - 1).empty());
  EXPECT_EQ(stampsAt(merger, 150 * kMillisecond).size(), 1U);
  EXPECT_FALSE(merger.due());
}

TEST(Merger, WaitsForNobodyWhoIsNotAwaited) {
  Merger merger(3, 0.05);
  merger.await(0, true);
  merger.push(2, reading(5, "c"));  // of a device that went stale since
  merger.push(0, reading(20, "a"));
  EXPECT_EQ(stampsAt(merger, 20), (std::vector<Timestamp>{5, 20}));
}

TEST(Merger, DropsAndCountsWhatComesTooLate) {
  Merger merger(2, 0.0);
  merger.push(0, reading(20, "a"));
  EXPECT_EQ(stampsAt(merger, 20).size(), 1U);
  EXPECT_FALSE(merger.push(1, reading(19, "b")));
  EXPECT_TRUE(merger.push(1, reading(20, "b")));  // of the same moment
  EXPECT_EQ(merger.late(1), 1U);
  EXPECT_EQ(merger.late(0), 0U);
  EXPECT_EQ(stampsAt(merger, 20).size(), 1U);
}

TEST(Merger, KeepsTheOrderOfDevicesWithinAMoment) {
  Merger merger(2, 0.05);
  merger.push(1, reading(7, "second"));
  merger.push(0, reading(7, "first"));
  merger.push(1, reading(7, "third"));
  EXPECT_EQ(merger.pop(100 * kMillisecond)->id.feature, "first");
  EXPECT_EQ(merger.pop(100 * kMillisecond)->id.feature, "second");
  EXPECT_EQ(merger.pop(100 * kMillisecond)->id.feature, "third");
}

TEST(Merger, KeepsTheNewestOfAFlood) {
  Merger merger(1, 5.0);
  for (Timestamp t = 0; t < 5000; ++t) merger.push(0, reading(t, "a"));
  EXPECT_EQ(merger.lost(0), 5000U - 1024U);
  EXPECT_EQ(merger.pop(10'000'000)->stamp, 5000 - 1024);
}

/// Readings of three devices with random delays: whatever the wait, stamps rise; with a wait above
/// the longest delay nothing is late, and the order is that of the stamps.
TEST(Merger, PutsDelayedReadingsInOrder) {
  struct Arrival {
    Timestamp at;
    std::size_t device;
    Timestamp stamp;
  };
  Random random(4);
  std::vector<Arrival> arrivals;
  for (std::size_t device = 0; device < 3; ++device) {
    Timestamp last = 0;
    for (Timestamp t = 0; t < 10'000'000; t += 20'000 + 7'000 * static_cast<Timestamp>(device)) {
      last = std::max(last, t + static_cast<Timestamp>(random.uniform(0.0, 40'000.0)));
      arrivals.push_back({last, device, t});
    }
  }
  std::stable_sort(arrivals.begin(), arrivals.end(),
                   [](const Arrival& a, const Arrival& b) { return a.at < b.at; });
  for (const double wait : {0.0, 0.02, 0.041}) {
    Merger merger(3, wait);
    for (std::size_t device = 0; device < 3; ++device) merger.await(device, true);
    std::vector<Timestamp> passed;
    for (const Arrival& one : arrivals) {
      merger.push(one.device, reading(one.stamp, "x"));
      for (const Timestamp stamp : stampsAt(merger, one.at)) passed.push_back(stamp);
    }
    for (const Timestamp stamp : stampsAt(merger, 20'000'000)) passed.push_back(stamp);
    EXPECT_TRUE(std::is_sorted(passed.begin(), passed.end()));
    const std::uint64_t late = merger.late(0) + merger.late(1) + merger.late(2);
    EXPECT_EQ(passed.size() + late, arrivals.size());
    EXPECT_EQ(late == 0, wait > 0.04) << wait;
  }
}

}  // namespace
}  // namespace ortung

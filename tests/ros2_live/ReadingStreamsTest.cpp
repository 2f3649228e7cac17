// Devices whose reading is due are waited for, and others are not.
#include <gtest/gtest.h>

#include <limits>

#include "ReadingStreams.hpp"

namespace ortung::ros2 {
namespace {

using std::chrono::milliseconds;

const SensorId kFront{"front", "LRF", "scan"};
const SensorId kRear{"rear", "LRF", "scan"};

class ReadingStreamsTest : public testing::Test {
 protected:
  ReadingStreamsTest() {
    streams_.expect(kFront);
    streams_.expect(kRear);
  }
  /// A reading that comes as soon as it was made.
  void take(const SensorId& id, int ms) { streams_.take(id, 1000 * ms, begin_ + milliseconds(ms)); }
  bool isAwaited(int ms, int now) const {
    return streams_.isAwaited(1000 * ms, begin_ + milliseconds(now));
  }
  ReadingStreams streams_;
  const ReadingStreams::Clock::time_point begin_;
};

TEST_F(ReadingStreamsTest, ADeviceIsAwaitedASecondForItsFirstReading) {
  EXPECT_FALSE(isAwaited(0, 0));
  take(kFront, 0);
  EXPECT_TRUE(isAwaited(0, 10));
  EXPECT_FALSE(isAwaited(0, 1000));
  take(kRear, 20);
  EXPECT_FALSE(isAwaited(0, 20));
}

TEST_F(ReadingStreamsTest, WhoseReadingIsDueIsAwaited) {
  for (int ms = 0; ms <= 200; ms += 100) {
    take(kFront, ms);
    take(kRear, ms + 50);
  }
  EXPECT_FALSE(isAwaited(250, 250));
  EXPECT_FALSE(isAwaited(279, 280));
  EXPECT_TRUE(isAwaited(280, 280));  // that of the front, by a fifth of its period early
  take(kFront, 300);
  EXPECT_FALSE(isAwaited(300, 300));
  EXPECT_TRUE(isAwaited(330, 330));
}

TEST_F(ReadingStreamsTest, AReadingThatWasLostChangesNoPeriod) {
  for (const int ms : {0, 100, 300, 400}) take(kFront, ms);
  take(kRear, 1000);
  EXPECT_TRUE(isAwaited(480, 480));
}

TEST_F(ReadingStreamsTest, WhoIsSilentIsNotAwaited) {
  for (int ms = 0; ms <= 200; ms += 100) take(kFront, ms);
  take(kRear, 5000);
  EXPECT_TRUE(isAwaited(600, 699));
  EXPECT_FALSE(isAwaited(600, 700));
  // Slow devices may be silent for longer.
  streams_.forget();
  take(kRear, 0);
  take(kRear, 10000);
  take(kFront, 10000);
  take(kFront, 40000);
  EXPECT_TRUE(isAwaited(39000, 39999));
  EXPECT_FALSE(isAwaited(40000, 40000));
}

TEST_F(ReadingStreamsTest, TimesOfAnySizeAreTaken) {
  constexpr Timestamp kFar = Timestamp{1} << 51;  // more than the seconds of a header
  streams_.take(kFront, -kFar, begin_);
  streams_.take(kFront, kFar, begin_);
  streams_.take(kRear, 0, begin_);
  EXPECT_FALSE(streams_.isAwaited(0, begin_));
  EXPECT_TRUE(streams_.isAwaited(2 * kFar, begin_));
  streams_.take(kFront, 0, begin_);  // late: what is newest stays
  EXPECT_FALSE(streams_.isAwaited(0, begin_));
}

}  // namespace
}  // namespace ortung::ros2

#include <gtest/gtest.h>

#include "EvenTimes.hpp"

namespace ortung::app {
namespace {

using Times = std::vector<Timestamp>;

TEST(EvenTimes, AreGivenOnceAndBeforeTheMoment) {
  EvenTimes times(10);
  EXPECT_EQ(times.before(1'000'000), Times{});
  EXPECT_EQ(times.before(1'000'000), Times{});
  EXPECT_EQ(times.before(1'050'000), Times{1'000'000});
  EXPECT_EQ(times.before(1'100'000), Times{});
  EXPECT_EQ(times.before(1'320'001), (Times{1'100'000, 1'200'000, 1'300'000}));
  EXPECT_EQ(times.before(1'320'002), Times{});
}

// 3 a second for a day: a period that is rounded would be off by 28 ms.
TEST(EvenTimes, DoNotDriftThoughThePeriodIsNoWholeNumber) {
  EvenTimes times(3);
  std::size_t count = 0;
  Timestamp newest = 0;
  for (Timestamp second = 0; second <= 86400; ++second)
    for (const Timestamp time : times.before(second * 1'000'000)) {
      newest = time;
      ++count;
    }
  EXPECT_EQ(count, 86400U * 3);
  EXPECT_EQ(newest, 86'399'666'667);  // a third of a second before the end
}

TEST(EvenTimes, LeaveOutWhatNobodyTellsOf) {
  EvenTimes times(1);
  times.before(0);
  EXPECT_EQ(times.before(60'000'000).size(), 60U) << "a minute is all right";
  EXPECT_EQ(times.before(9'000'000'000'500'000), Times{60'000'000}) << "and no 9 billion others";
  EXPECT_EQ(times.before(9'000'000'001'500'000), Times{9'000'000'001'000'000});
}

TEST(EvenTimes, BeginAnewWhereTheClockIsSetBack) {
  EvenTimes times(2);
  times.before(50'000'000);
  times.before(51'000'000);
  EXPECT_EQ(times.before(3'300'000), Times{});
  EXPECT_EQ(times.before(4'000'000), (Times{3'300'000, 3'800'000}));
}

}  // namespace
}  // namespace ortung::app

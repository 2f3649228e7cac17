#include <gtest/gtest.h>

#include "UpdateTime.hpp"

namespace ortung {
namespace {

TEST(UpdateTime, IsWhatWeighingLeavesAndATenthAtLeast) {
  MclConfig config;
  config.budgetMs = 20.0;
  UpdateTime time(config);
  EXPECT_DOUBLE_EQ(time.left(), 16.0);
  time.spend(5e6);
  time.spend(1e6);
  EXPECT_DOUBLE_EQ(time.left(), 10.0);
  time.spend(50e6);
  EXPECT_DOUBLE_EQ(time.left(), 2.0);
  time.begin();
  EXPECT_DOUBLE_EQ(time.left(), 16.0);
}

/// Time that a test moves on, of an update of 20 ms of which two are a margin.
struct Clock {
  Clock() {
    config.budgetMs = 20.0;
    time.keep([this] { return now; });
    time.begin();
  }
  /// Does work that takes so long.
  void measure(Work work, double size, double milliseconds) {
    const UpdateTime::Measured its(time, work, size);
    now += milliseconds;
  }
  bool begins(Work work, double milliseconds) {
    return static_cast<bool>(UpdateTime::Step(time, work, milliseconds));
  }

  double now = 100.0;  ///< [ms]
  MclConfig config;
  UpdateTime time{config};
};

TEST(UpdateTime, WithoutAClockEverythingBegins) {
  MclConfig config;
  UpdateTime time(config);
  EXPECT_FALSE(time.endOf(Work::kSearching));
  EXPECT_FALSE(time.endOfWeighing(1.0));
  EXPECT_TRUE(time.isTimeFor(1e9));
  EXPECT_TRUE(static_cast<bool>(UpdateTime::Step(time, Work::kAround, 1e9)));
  EXPECT_GT(time.mostSamples(), 1000000U);
  EXPECT_GT(time.posesInTime(1e9), 1000000U);
}

TEST(UpdateTime, AStepBeginsIfItIsOverBeforeWhatMustFollow) {
  Clock clock;
  EXPECT_TRUE(clock.begins(Work::kAround, 18.0));
  EXPECT_FALSE(clock.begins(Work::kAround, 18.1));
  clock.measure(Work::kClusters, UpdateTime::sizeOf(1000), 4.0);
  clock.measure(Work::kRefining, 1.0, 3.0);
  clock.time.begin();
  clock.time.follows(Work::kClusters, 2000);  // 6 and 3 ms
  EXPECT_TRUE(clock.begins(Work::kAround, 8.9));
  EXPECT_FALSE(clock.begins(Work::kAround, 9.1));
  clock.now += 8.0;
  EXPECT_TRUE(clock.begins(Work::kAround, 0.9));
  EXPECT_FALSE(clock.begins(Work::kAround, 1.1));
  clock.time.follows(Work::kEstimate, 2000);  // 3 ms
  EXPECT_TRUE(clock.begins(Work::kAround, 6.9));
}

TEST(UpdateTime, ASliceBeginsIfTheLongestOneLatelyWouldFit) {
  Clock clock;
  const IsOver isOver = clock.time.endOf(Work::kSearching);
  clock.now += 3.0;
  EXPECT_FALSE(isOver());
  clock.now += 1.0;
  EXPECT_FALSE(isOver());
  clock.now += 7.9;
  EXPECT_FALSE(isOver()) << "twice 3 ms, since a time at most doubles at once";
  clock.now += 0.5;
  EXPECT_TRUE(isOver()) << "6 ms do not fit into 5.6";
}

TEST(UpdateTime, WeighingLeavesTimeToWhatHasAskedForItBefore) {
  Clock clock;
  const auto end = [&] {
    clock.time.begin();
    const double begun = clock.now;
    const IsOver isOver = clock.time.endOfWeighing(1.0);
    do clock.now += 0.01;
    while (!isOver());
    return clock.now - begun;
  };
  EXPECT_NEAR(end(), 0.75 * 18.0, 0.03);
  EXPECT_FALSE(clock.begins(Work::kAround, 6.0));
  EXPECT_TRUE(clock.begins(Work::kDelays, 4.0));
  EXPECT_NEAR(end(), 8.0, 0.03);
  EXPECT_TRUE(clock.begins(Work::kAround, 9.5));
  EXPECT_NEAR(end(), 8.5, 0.03) << "what begins asks for it again";
  EXPECT_FALSE(clock.begins(Work::kAround, 1000.0));
  EXPECT_NEAR(end(), 0.4 * 18.0, 0.03) << "something is left for weighing";
  EXPECT_NEAR(end(), 0.75 * 18.0, 0.03) << "nothing asks any more";
}

TEST(UpdateTime, NothingWaitsForever) {
  Clock clock;
  clock.now += 20.0;
  EXPECT_FALSE(clock.begins(Work::kSearching, 0.1));
  EXPECT_TRUE(clock.begins(Work::kSearching, 0.1)) << "a slice is small";
  EXPECT_FALSE(clock.begins(Work::kSearching, 0.1));
  int refused = 0;
  while (!clock.begins(Work::kAround, 5.0)) ++refused;
  EXPECT_EQ(refused, 200);
  EXPECT_FALSE(clock.begins(Work::kAround, 5.0));
}

TEST(UpdateTime, MeasuresWorkWithoutTheStepsInIt) {
  Clock clock;
  {
    const UpdateTime::Measured its(clock.time, Work::kMoment, 2.0);
    clock.now += 1.0;
    const UpdateTime::Step outer(clock.time, Work::kAround, 0.0);
    clock.now += 3.0;
    const UpdateTime::Step inner(clock.time, Work::kDrawing, 0.0);
    clock.now += 2.0;
  }
  EXPECT_NEAR(clock.time.timeOf(Work::kMoment, 2.0), 1.0, 1e-9);
}

TEST(UpdateTime, LeavesHalfOfItToOtherWorkThanEstimating) {
  Clock clock;
  EXPECT_NEAR(static_cast<double>(clock.time.mostSamples()), 10.0 / 150e-6 - 1000.0, 1.0);
  clock.measure(Work::kClusters, 1000.0, 1.0);
  clock.measure(Work::kResampling, 1000.0, 1.0);
  EXPECT_NEAR(static_cast<double>(clock.time.mostSamples()), 4000.0, 1.0);
  EXPECT_NEAR(clock.time.timeToEstimate(4000), 10.0, 1e-9);
}

TEST(WorkTimes, KeepTheLongestTimeLatelyByItsSize) {
  WorkTimes times;
  EXPECT_EQ(times.of(Work::kAround), 0.0);
  times.took(Work::kAround, 10.0, 5.0);
  EXPECT_DOUBLE_EQ(times.of(Work::kAround, 4.0), 2.0);
  times.took(Work::kAround, 1.0, 0.1);
  EXPECT_DOUBLE_EQ(times.of(Work::kAround), 0.495);
  times.took(Work::kAround, 1.0, 1000.0);
  EXPECT_DOUBLE_EQ(times.of(Work::kAround), 0.99) << "at most twice as long";
  for (int i = 0; i < 500; ++i) times.took(Work::kAround, 1.0, 0.2);
  EXPECT_DOUBLE_EQ(times.of(Work::kAround), 0.2);
}

}  // namespace
}  // namespace ortung

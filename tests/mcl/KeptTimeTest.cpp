// Updates keep their time by a clock, which the test moves on with the work that is done.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "FakeRun.hpp"
#include "IsOver.hpp"
#include "NewReadings.hpp"
#include "SampleLimit.hpp"
#include "Told.hpp"
#include "ortung/base/Workers.hpp"
#include "ortung/core/Polishable.hpp"

namespace ortung {
namespace {

using test::FakeRun;
using test::Told;

constexpr double kBudget = 10.0;  ///< [ms]

/// Where the time of a test's work is counted.
struct Spent {
  double now = 0.0;   ///< [ms]
  double each = 0.0;  ///< time of a pose [ms]
  double slope = 0.0;
  double look = 0.0;  ///< time to read the clock
  std::size_t slopes = 0;
};

/// Tells nothing, but takes its time for each pose, and for each slope.
class SlowWeigher final : public Weigher, public Polishable {
 public:
  explicit SlowWeigher(Spent& spent) : spent_(spent) {}
  Slope slopeAt(const Pose2&) const override {
    spent_.now += spent_.slope;
    ++spent_.slopes;
    return {};
  }

 private:
  void weigh(const SampleView& poses, std::span<float>) const override {
    spent_.now += spent_.each * static_cast<double>(poses.size());
  }
  Spent& spent_;
};

class SlowData final : public Told {
 public:
  explicit SlowData(Spent& spent) : Told("slow", nullptr), spent_(spent) {}
  std::shared_ptr<const Weigher> makeWeigher() const override {
    return std::make_shared<SlowWeigher>(spent_);
  }

 private:
  Spent& spent_;
};

/// The room's robot, and a feature that tells nothing but takes its time.
class SlowRun {
 public:
  explicit SlowRun(double microseconds, double budget = kBudget) {
    spent.each = 1e-3 * microseconds;
    run.container.add(std::make_unique<SlowData>(spent));
    config = run.config();
    config.budgetMs = budget;
    run.begin(FakeRun::onCircle(1, 0.5, 0.3), 5);
  }

  std::unique_ptr<Mcl> mcl(bool keepsTime = true) {
    auto made = run.mcl(config);
    if (keepsTime)
      made->keepTime([this] {
        spent.now += spent.look;
        return spent.now;
      });
    return made;
  }
  /// @returns the time that the update took [ms]
  double update(Mcl& mcl) {
    run.drive();
    run.container.set({run.stamp, {"told", "test", "slow"}, {}});
    const double before = spent.now;
    isTold = mcl.update(run.container);
    return spent.now - before;
  }
  double slice() const { return static_cast<double>(kTimedPoses) * spent.each; }

  FakeRun run;
  MclConfig config;
  Spent spent;
  bool isTold = false;
};

std::vector<float> bitsOf(const SampleSet& set) {
  std::vector<float> all;
  for (const auto* row : {&set.x, &set.y, &set.theta, &set.logWeight})
    all.insert(all.end(), row->begin(), row->end());
  return all;
}

// At 1 us a pose, the start's 20,000 samples would take 20 ms of the 10.
TEST(KeptTime, IsKeptByAStartWithMoreSamplesThanThereIsTimeFor) {
  SlowRun slow(1.0);
  slow.config.maxSamples = 20000;
  const auto mcl = slow.mcl();
  mcl->startAt(slow.run.truth, 0.3, 0.1);
  int told = 0;
  for (int i = 0; i < 50; ++i) {
    EXPECT_LE(slow.update(*mcl), kBudget) << i;
    if (slow.isTold) ++told;
    EXPECT_LT(distance(mcl->estimate(slow.run.stamp)->pose, slow.run.truth), 0.15) << i;
  }
  EXPECT_GT(told, 20);
}

TEST(KeptTime, IsKeptByAGlobalStart) {
  SlowRun slow(1.0);
  const auto mcl = slow.mcl();
  mcl->startGlobal();
  int updates = 0;
  do {
    EXPECT_LE(slow.update(*mcl), kBudget) << updates;
  } while (!slow.isTold && ++updates < 500);
  EXPECT_GT(updates, 5);
  EXPECT_LT(distance(mcl->estimate().pose, slow.run.truth), 0.15);
}

// Readings fit nowhere, so alternatives are drawn and the field is searched; then the robot is
// found where it was put.
TEST(KeptTime, IsKeptAfterAKidnap) {
  SlowRun slow(0.5);
  const auto mcl = slow.mcl();
  mcl->startAt(slow.run.truth, 0.1, 0.1);
  for (int i = 0; i < 20; ++i) slow.update(*mcl);
  slow.run.truth = FakeRun::onCircle(-1.5, -0.5, 2.5);
  bool hasSearched = false;
  for (int i = 0; i < 300; ++i) {
    EXPECT_LE(slow.update(*mcl), kBudget) << i;
    hasSearched = hasSearched || mcl->isSearching();
  }
  EXPECT_TRUE(hasSearched);
  EXPECT_LT(distance(mcl->estimate().pose, slow.run.truth), 0.15);
}

/// Starts anywhere, drives, and is carried away.
/// @returns the longest update [ms]
double longestOf(SlowRun& slow) {
  const auto mcl = slow.mcl();
  mcl->startGlobal();
  double longest = 0.0;
  int told = 0;
  for (int i = 0; i < 3000 && told < 250; ++i) {
    longest = std::max(longest, slow.update(*mcl));
    if (slow.isTold && ++told == 60) slow.run.truth = FakeRun::onCircle(-1.5, -0.5, 2.5);
  }
  EXPECT_LT(distance(mcl->estimate().pose, slow.run.truth), 0.15);
  return longest;
}

// Whatever is done, and however long its steps take: what can't be stopped is one slice.
TEST(KeptTime, NoUpdateTakesMoreThanItsBudgetAndOneSlice) {
  for (const double budget : {2.0, 5.0, 20.0})
    for (const double poses : {1e4, 5e4}) {
      SCOPED_TRACE(testing::Message() << budget << " ms, " << poses << " poses");
      SlowRun slow(1e3 * budget / poses, budget);
      EXPECT_LE(longestOf(slow), budget + slow.slice());
    }
}

// The clock itself counts: between two looks at it there are many poses.
TEST(KeptTime, LooksAtTheClockOnceInManyPoses) {
  SlowRun slow(0.5, 5.0);
  slow.spent.look = 2e-3;
  EXPECT_LE(longestOf(slow), 5.0 + slow.slice());
}

// A slope that takes a fifth of the budget: the refinement ends before it converges.
TEST(KeptTime, RefinesAsFarAsThereIsTime) {
  SlowRun slow(0.1, 5.0);
  slow.spent.slope = 1.0;
  const auto mcl = slow.mcl();
  mcl->startAt(slow.run.truth, 0.1, 0.1);
  for (int i = 0; i < 5; ++i) slow.update(*mcl);
  slow.spent.slopes = 0;
  for (int i = 0; i < 60; ++i) EXPECT_LE(slow.update(*mcl), 5.0) << i;
  EXPECT_GT(slow.spent.slopes, 60U);
  EXPECT_LT(distance(mcl->estimate().pose, slow.run.truth), 0.15);
}

// A clock that time suffices by changes nothing.
TEST(KeptTime, GivesTheSameBitsIfThereIsEnough) {
  const auto ran = [](bool keepsTime) {
    SlowRun slow(0.0);
    slow.config.maxSamples = 10000;
    const auto mcl = slow.mcl(keepsTime);
    mcl->startGlobal();
    for (int i = 0; i < 60; ++i) {
      slow.update(*mcl);
      if (i == 30) slow.run.truth = FakeRun::onCircle(-1.5, -0.5, 2.5);
    }
    return bitsOf(mcl->samples());
  };
  EXPECT_EQ(ran(true), ran(false));
}

// The oldest readings come first; the others wait, and are not lost.
TEST(KeptTime, LeavesReadingsOfLaterStampsToTheNextUpdate) {
  SlowRun slow(3.5);
  slow.config.minSamples = slow.config.maxSamples = 2500;  // 8.8 ms
  const auto mcl = slow.mcl();
  mcl->startAt(slow.run.truth, 0.1, 0.1);
  slow.update(*mcl);
  slow.run.drive(2.0, 0.0);
  slow.run.container.set({slow.run.stamp - 20'000, {"told", "test", "slow"}, {}});
  ASSERT_TRUE(mcl->update(slow.run.container));
  EXPECT_EQ(mcl->estimate().stamp, slow.run.stamp - 20'000);
  ASSERT_TRUE(mcl->update(slow.run.container));
  EXPECT_EQ(mcl->estimate().stamp, slow.run.stamp);
}

/// Samples on a line: x is the number.
SampleSet line(std::size_t n) {
  SampleSet set;
  set.resize(n);
  for (std::size_t i = 0; i < n; ++i) set.x[i] = static_cast<float>(i);
  return set;
}

TEST(WeighUntil, WeighsPartsThatAreSpreadEvenly) {
  constexpr std::size_t kSamples = 10000;  // forty parts
  const SampleSet set = line(kSamples);
  Told told("x", [](const SampleView& poses, std::size_t i) { return poses.x[i]; });
  const std::vector<NewReading> news{{&told, 1, told.makeWeigher()}};
  Workers workers(1);
  std::vector<float> logs;
  int looks = 0;
  const Parts all = weighUntil({}, news, set, workers, 1, logs);
  EXPECT_EQ(all.weighed, all.all);
  EXPECT_EQ(logs, set.x);
  const Parts some = weighUntil([&] { return ++looks == 16; }, news, set, workers, 1, logs);
  EXPECT_EQ(some.all, 40U);
  EXPECT_EQ(some.weighed, 16U);
  double sum = 0.0;
  std::size_t count = 0;
  for (std::size_t i = 0; i < kSamples; ++i) {
    if (!some.has(i)) continue;
    ASSERT_EQ(logs[i], set.x[i]);
    sum += static_cast<double>(i);
    ++count;
  }
  EXPECT_EQ(count, 4000U);
  EXPECT_NEAR(sum / static_cast<double>(count), kSamples / 2.0, 20.0);
  EXPECT_EQ(weighUntil([] { return true; }, news, set, workers, 1, logs).weighed, 1U);
}

TEST(SampleLimit, FallsToWhatWasWeighedAndRisesSlowly) {
  MclConfig config;
  config.maxSamples = 20000;
  config.minSamples = 500;
  SampleLimit limit(config);
  EXPECT_EQ(limit.most(), 20000U);
  limit.weighed(20000, true);
  EXPECT_EQ(limit.most(), 20000U);
  limit.weighed(6000, false);
  EXPECT_EQ(limit.most(), 6000U);
  limit.weighed(6000, true);
  EXPECT_EQ(limit.most(), 6601U);
  limit.late(1000);
  EXPECT_EQ(limit.most(), 800U);
  limit.late(100);
  EXPECT_EQ(limit.most(), 500U);
  for (int i = 0; i < 100; ++i) limit.weighed(500, true);
  EXPECT_EQ(limit.most(), 20000U);
}

}  // namespace
}  // namespace ortung

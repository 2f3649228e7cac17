// What tasks will cost, told by those that were run.
#include <gtest/gtest.h>

#include "SweepCosts.hpp"

namespace ortung::app {
namespace {

SweepTask task(std::vector<std::string> values) { return {"", "", {}, std::move(values)}; }

TEST(SweepCosts, KnowNothingBeforeAnythingWasRun) {
  const SweepCosts costs({"log", "seed"});
  EXPECT_EQ(costs.known(), 0u);
  EXPECT_FALSE(costs.estimate(task({"a", "1"})));
}

TEST(SweepCosts, TakeTheClosestThatWereRun) {
  SweepCosts costs({"log", "n", "seed"});
  costs.add(task({"long", "500", "1"}), {10.0, 100.0});
  costs.add(task({"long", "500", "2"}), {14.0, 90.0});
  costs.add(task({"long", "2000", "1"}), {60.0, 300.0});
  costs.add(task({"short", "500", "1"}), {4.0, 50.0});
  EXPECT_EQ(costs.known(), 4u);
  const auto expectCost = [&](std::vector<std::string> values, double seconds, double megabytes) {
    const auto cost = costs.estimate(task(std::move(values)));
    ASSERT_TRUE(cost);
    EXPECT_DOUBLE_EQ(cost->seconds, seconds);
    EXPECT_DOUBLE_EQ(cost->megabytes, megabytes);
  };
  expectCost({"long", "500", "9"}, 12.0, 100.0);    // all but the seed
  expectCost({"long", "9000", "1"}, 28.0, 300.0);   // the same log
  expectCost({"other", "9000", "1"}, 22.0, 300.0);  // all
}

// A key that is no seed is never left out, and a sweep may have the seed as its first or only key.
TEST(SweepCosts, SeedsCostNothingWhereverTheyStand) {
  SweepCosts first({"seed", "n"});
  first.add(task({"1", "500"}), {1.0, 10.0});
  first.add(task({"1", "2000"}), {5.0, 20.0});
  EXPECT_DOUBLE_EQ(first.estimate(task({"2", "2000"}))->seconds, 5.0);
  EXPECT_DOUBLE_EQ(first.estimate(task({"1", "100"}))->seconds, 3.0);
  SweepCosts only({"n"});
  only.add(task({"500"}), {1.0, 10.0});
  only.add(task({"2000"}), {5.0, 20.0});
  EXPECT_DOUBLE_EQ(only.estimate(task({"500"}))->seconds, 1.0);
  EXPECT_DOUBLE_EQ(only.estimate(task({"100"}))->seconds, 3.0);
}

}  // namespace
}  // namespace ortung::app

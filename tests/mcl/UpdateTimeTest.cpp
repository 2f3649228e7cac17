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

}  // namespace
}  // namespace ortung

// What somebody may say, against sums done by hand.
#include <gtest/gtest.h>

#include "TalkBudget.hpp"

namespace ortung::test {
namespace {

constexpr Timestamp kSecond = 1'000'000;
constexpr double kPlenty = 1e9;

TEST(TalkBudget, ThereIsAShareOfASecondAtTheBeginning) {
  server::TalkBudget budget(10.0, kPlenty, 0.3);
  for (int line = 0; line <= 3; ++line) {
    EXPECT_EQ(budget.wait(kSecond), 0.0) << line;
    budget.spend(1.0, 1.0);
  }
  EXPECT_DOUBLE_EQ(budget.wait(kSecond), 0.1);  // the fourth was debt
}

TEST(TalkBudget, ItGrowsBackToWhatASecondGives) {
  server::TalkBudget budget(10.0, kPlenty);
  budget.wait(kSecond);
  budget.spend(30.0, 1.0);
  EXPECT_DOUBLE_EQ(budget.wait(kSecond), 2.0);
  EXPECT_DOUBLE_EQ(budget.wait(2 * kSecond), 1.0);
  EXPECT_DOUBLE_EQ(budget.wait(3 * kSecond), 0.0);
  EXPECT_EQ(budget.wait(1000 * kSecond), 0.0);
  budget.spend(11.0, 1.0);  // a thousand seconds of silence give no more than one
  EXPECT_NEAR(budget.wait(1000 * kSecond), 0.1, 1e-12);
}

TEST(TalkBudget, BytesAreCountedBesideLines) {
  server::TalkBudget budget(kPlenty, 100.0);
  budget.wait(kSecond);
  budget.spend(1.0, 350.0);
  EXPECT_DOUBLE_EQ(budget.wait(kSecond), 2.5);
}

}  // namespace
}  // namespace ortung::test

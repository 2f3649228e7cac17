// What clients say to each other: what it costs, and who hears it when. Without sockets, too.
#include <gtest/gtest.h>

#include "FakeHost.hpp"
#include "RunningBoard.hpp"

namespace ortung::test {
namespace {

TEST(Talk, WhatIsSaidCostsForEachWhoHearsIt) {
  CountingWorld world;
  BoardConfig config = lockstepConfig();
  config.limits.talkLines = 0.001;  // a second: so nothing grows back while the test runs
  config.limits.talkBytes = 1e9;
  FakeHost host(world, config);
  auto [anna, outlet] = host.join();
  for (int i = 0; i < 5; ++i) host.join("viewer");
  anna.receive("SAY one\nSAY two\nTIME\n");
  host.settle();
  EXPECT_EQ(host.count(1, "OK SAY"), 1u);  // the first one is always permitted: the rest is debt
  const std::string refusal =
      "ERR limit that is too much talk for all who hear it; say it again in ";
  ASSERT_EQ(host.count(1, refusal), 1u);
  for (const auto& [client, line] : host.told) {
    if (!line.starts_with(refusal)) continue;
    // Five lines at one in 1000 s, of which a fifth of a second's was there, in milliseconds.
    const long wait = std::stol(line.substr(refusal.size()));
    EXPECT_LE(wait, 4'999'800);
    EXPECT_GT(wait, 4'900'000);
    EXPECT_TRUE(line.ends_with(" ms")) << line;
  }
  EXPECT_EQ(host.count(1, "OK TIME"), 1u);
  for (server::ClientId other = 2; other <= 6; ++other) {
    EXPECT_FALSE(host.clients[other - 1]->hearOn());
    EXPECT_EQ(host.count(other, "* SAY client=1 name=guest one"), 1u);
    EXPECT_EQ(host.count(other, "* SAY"), 1u);
  }
}

TEST(Talk, LongTextsAreRefused) {
  CountingWorld world;
  FakeHost host(world, lockstepConfig());
  auto [anna, outlet] = host.join();
  host.join();
  anna.receive("SAY " + std::string(4096, 'x') + "\nSAY " + std::string(4097, 'x') + "\n");
  host.settle();
  EXPECT_EQ(host.count(1, "OK SAY"), 1u);
  EXPECT_EQ(host.count(1, "ERR limit a text to SAY has at most 4096 bytes"), 1u);
}

TEST(Talk, TheBudgetGrowsBackWithTimeAndDebtsArePaidFirst) {
  server::TalkBudget budget(100.0, 1000.0);  // a second
  constexpr Timestamp kSecond = 1'000'000;
  EXPECT_EQ(budget.wait(kSecond), 0.0);
  budget.spend(50.0, 3000.0);  // two seconds' bytes too many
  EXPECT_DOUBLE_EQ(budget.wait(kSecond), 2.0);
  EXPECT_DOUBLE_EQ(budget.wait(2 * kSecond), 1.0);
  EXPECT_DOUBLE_EQ(budget.wait(3 * kSecond), 0.0);
  budget.spend(300.0, 0.0);
  EXPECT_DOUBLE_EQ(budget.wait(3 * kSecond), 2.0);
  EXPECT_DOUBLE_EQ(budget.wait(100 * kSecond), 0.0);
  budget.spend(150.0, 0.0);  // nobody saves for more than a second
  EXPECT_DOUBLE_EQ(budget.wait(100 * kSecond), 0.5);
}

TEST(Talk, WaitsBehindReadingsAndIsLostBeforeAnybodyIsDropped) {
  CountingWorld world;
  BoardConfig config = lockstepConfig();
  config.limits.talk = 1000;
  FakeHost host(world, config);
  auto [anna, outlet] = host.join();
  outlet.unread = 1;  // something is on its way to her
  for (int i = 0; i < 100; ++i) anna.hear("SAY client=2 name=b " + std::to_string(i));
  EXPECT_FALSE(anna.hearOn());
  EXPECT_EQ(host.count(1, "* SAY"), 0u);
  anna.receive("STATUS\n");
  host.settle();
  EXPECT_EQ(host.count(1, "OK STATUS"), 1u);  // replies do not wait
  outlet.unread = 0;
  while (anna.hearOn()) {
  }
  const std::size_t heard = host.count(1, "* SAY");
  EXPECT_GT(heard, 30u);
  EXPECT_LT(heard, 60u);
  EXPECT_EQ(host.told.back().second, "* LOST says=" + std::to_string(100 - heard));
  EXPECT_FALSE(anna.isOver());
}

TEST(Talk, ComesInPiecesSoThatReadingsComeBetween) {
  CountingWorld world;
  FakeHost host(world, lockstepConfig());
  auto [anna, outlet] = host.join();
  const std::string text = "SAY client=2 name=b " + std::string(980, 'x');
  for (int i = 0; i < 50; ++i) anna.hear(text);
  EXPECT_TRUE(anna.hearOn());
  EXPECT_LT(host.count(1, "* SAY"), 12u);
  while (anna.hearOn()) {
  }
  EXPECT_EQ(host.count(1, "* SAY"), 50u);
  EXPECT_EQ(host.count(1, "* LOST"), 0u);
}

}  // namespace
}  // namespace ortung::test

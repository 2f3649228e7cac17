// Who gets a turn when, and who hears what: conversations without sockets, so that nothing depends
// on how fast anybody is.
#include <gtest/gtest.h>

#include <algorithm>

#include "FakeHost.hpp"
#include "RunningBoard.hpp"

namespace ortung::test {
namespace {

std::string repeated(const std::string& line, int times) {
  std::string all;
  for (int i = 0; i < times; ++i) all += line + "\n";
  return all;
}

TEST(Turns, WhoSendsMuchGetsAFewLinesDoneAtATime) {
  CountingWorld world;
  FakeHost host(world, lockstepConfig());
  auto [client, outlet] = host.join();
  client.receive(repeated("TIME", 2000));
  std::size_t done = host.count(1, "OK TIME");
  EXPECT_GE(done, 1u);
  EXPECT_LE(done, 32u);
  while (done < 2000) {
    ASSERT_EQ(host.backlog.size(), 1u);  // once, however often it is asked
    client.receive("");
    EXPECT_EQ(host.count(1, "OK TIME"), done) << "not before its turn";
    host.giveTurns();
    const std::size_t now = host.count(1, "OK TIME");
    ASSERT_GT(now, done);
    ASSERT_LE(now, done + 32);
    done = now;
  }
  EXPECT_FALSE(client.hasOpenRequests());
}

TEST(Turns, AReplyComesBeforeTheBacklogOfAnotherIsWorkedOff) {
  CountingWorld world;
  FakeHost host(world, lockstepConfig());
  auto [attacker, itsOutlet] = host.join();
  auto [honest, outlet] = host.join();
  host.told.clear();
  attacker.receive(repeated("STATUS", 60) + repeated("TIME", 1000));
  while (!host.backlog.empty() && host.count(1) == 0) host.giveTurns();
  honest.receive("STATUS\n");  // behind 60 orders of the other, as far as time goes
  host.keeper.runOnce();
  host.runTasks();
  const auto place = std::find_if(host.told.begin(), host.told.end(),
                                  [](const auto& line) { return line.first == 2; });
  ASSERT_NE(place, host.told.end());
  EXPECT_LE(place - host.told.begin(), 2);
}

TEST(Turns, OrdersOfOneClientStayInTheirOrder) {
  CountingWorld world;
  FakeHost host(world, lockstepConfig());
  auto [one, outletOfOne] = host.join();
  auto [other, outletOfOther] = host.join();
  for (int i = 0; i < 50; ++i) {
    one.receive("#a" + std::to_string(i) + " STATUS\n");
    if (i % 3 == 0) other.receive("#b" + std::to_string(i) + " STATUS\n");
  }
  host.settle();
  int next = 0;
  for (const auto& [client, line] : host.told)
    if (client == 1 && line.starts_with("#a")) {
      EXPECT_TRUE(line.starts_with("#a" + std::to_string(next++) + " OK")) << line;
    }
  EXPECT_EQ(next, 50);
  EXPECT_EQ(host.count(2, "#b"), 17u);
}

TEST(Turns, OrdersBeyondTheLimitAreNotTakenAndInputIsNotReadWithoutBound) {
  CountingWorld world;
  BoardConfig config = lockstepConfig();
  config.limits.orders = 10;
  config.limits.line = 1000;
  FakeHost host(world, config);
  auto [client, outlet] = host.join();
  client.receive("CREATE r\n" + kAnyRobot + ".\n");
  host.settle();
  ASSERT_EQ(host.count(1, "OK CREATE"), 1u);
  std::size_t sent = 0;
  while (client.wantsInput() && sent < 100'000) {  // the world does nothing meanwhile
    client.receive(repeated("VELOCITY v_m_s=1", 10));
    sent += 170;
    host.giveTurns();
  }
  EXPECT_GT(sent, 1000u);
  EXPECT_LT(sent, 1000u + 10 * 17u + 2 * 170u);
  host.keeper.runOnce();
  EXPECT_EQ(world.commands(), 10u);
  host.settle();
  EXPECT_EQ(world.commands(), sent / 17);
  EXPECT_TRUE(client.wantsInput());
}

TEST(Turns, SubscribersThatAreBehindGetLessOftenWhatIsNewest) {
  CountingWorld world;
  FakeHost host(world, lockstepConfig());
  auto [client, outlet] = host.join();
  client.receive("CREATE r\n" + kAnyRobot + ".\nSUBSCRIBE\nLOCKSTEP on\n");
  host.settle();
  const auto cycle = [&] {
    client.receive("NEXT none/none/none\n");
    host.settle();
    client.onCycle();
  };
  cycle();
  EXPECT_EQ(host.count(1, "* UPDATE"), 1u);
  outlet.unread = 70'000;
  cycle();
  cycle();
  EXPECT_EQ(host.count(1, "* UPDATE"), 1u);
  outlet.unread = 0;
  cycle();
  EXPECT_EQ(host.count(1, "* UPDATE"), 2u);
  EXPECT_EQ(host.told.back().second,
            "30000 counter/counter/cycle 2 3 0");  // what was missed is not
}

TEST(Turns, SubscribersKeepTheirRhythmThoughNoCycleEndsWithIt) {
  CountingWorld world;
  world.cycle = 30'000;
  FakeHost host(world, lockstepConfig());
  auto [client, outlet] = host.join();
  client.receive("CREATE r\n" + kAnyRobot +
                 ".\nSUBSCRIBE period_s=0.1 none/none/none\nLOCKSTEP on\n");
  host.settle();
  for (int cycle = 1; cycle <= 40; ++cycle) {
    client.receive("NEXT none/none/none\n");
    host.settle();
    client.onCycle();
  }
  std::vector<std::string> told;
  for (const auto& [id, line] : host.told)
    if (line.starts_with("* UPDATE")) told.push_back(line.substr(0, line.find(" lines=")));
  // Due at 30, 100, 200, ... ms; sent when the next cycle has ended, ten in a second.
  std::vector<std::string> expected;
  for (const char* now : {"30", "120", "210", "300", "420", "510", "600", "720", "810", "900",
                          "1020", "1110", "1200"})
    expected.push_back(std::string("* UPDATE robot=1 now=") + now + "000");
  EXPECT_EQ(told, expected);
}

TEST(Turns, WhoIsOwedOneAnswerWaits) {
  CountingWorld world;
  FakeHost host(world, lockstepConfig());
  auto [client, outlet] = host.join();
  EXPECT_FALSE(client.isWaiting());
  client.receive("STATUS\n");  // the world has to be asked
  EXPECT_TRUE(client.isWaiting());
  EXPECT_TRUE(client.hasOpenRequests());
  host.settle();
  EXPECT_FALSE(client.isWaiting());
  client.receive("CREATE r\n" + kAnyRobot + ".\n");  // a file is read, no order was given yet
  EXPECT_TRUE(client.isWaiting());
  EXPECT_TRUE(client.hasOpenRequests());
  host.settle();
  EXPECT_FALSE(client.isWaiting());
  EXPECT_EQ(host.count(1, "OK CREATE"), 1u);
}

TEST(Turns, WhoWatchesARobotAndAsksForItsReadingsGoesOnWatching) {
  CountingWorld world;
  FakeHost host(world, lockstepConfig());
  auto [anna, outletOfAnna] = host.join();
  auto [viewer, outlet] = host.join("viewer");
  anna.receive("CREATE r\n" + kAnyRobot + ".\nLOCKSTEP on\n");
  host.settle();
  viewer.receive("SUBSCRIBE robot=1 none/none/none\nUPDATE robot=1\nREAD robot=1\n");
  host.settle();
  EXPECT_EQ(host.count(2, "OK UPDATE robot=1"), 1u);
  for (std::size_t cycle = 1; cycle <= 2; ++cycle) {
    anna.receive("NEXT none/none/none\n");
    host.settle();
    viewer.onCycle();
    EXPECT_EQ(host.count(2, "* UPDATE robot=1"), cycle);
  }
  EXPECT_EQ(host.count(2, "* ERR"), 0u);
}

TEST(Turns, NobodyKeepsTheReadingsOfRobotsThatHaveLeft) {
  CountingWorld world;
  FakeHost host(world, lockstepConfig());
  auto [anna, outletOfAnna] = host.join();
  auto [viewer, outlet] = host.join("viewer");
  for (const char* robot : {"one", "two"}) {
    anna.receive(std::string("CREATE ") + robot + "\n" + kAnyRobot + ".\n");
    host.settle();
  }
  const std::weak_ptr<server::RobotReadings> one = host.keeper.readings(1);
  const std::weak_ptr<server::RobotReadings> two = host.keeper.readings(2);
  viewer.receive("SUBSCRIBE robot=1\nSUBSCRIBE robot=2\n");
  host.settle();
  anna.receive("REMOVE robot=1\n");
  host.settle();
  EXPECT_TRUE(one.expired()) << "watched before the other one";
  viewer.receive("UNSUBSCRIBE\n");
  anna.receive("REMOVE robot=2\n");
  host.settle();
  EXPECT_TRUE(two.expired()) << "watched once";
}

// --- worlds that run by themselves

/// Its time is its own; it is looked at once a period.
class LiveWorld : public CountingWorld {
 public:
  explicit LiveWorld(Timestamp period) : period_(period) {}
  ~LiveWorld() override = default;
  Timestamp livePeriod() const override { return period_; }
  bool isReady() const override { return ready; }
  bool ready = true;

 private:
  Timestamp period_;
};

TEST(LiveWorlds, AreLookedAtOnceAPeriod) {
  LiveWorld world(3'600'000'000);
  FakeHost host(world, {});
  for (int i = 0; i < 5; ++i) host.keeper.runOnce();
  EXPECT_EQ(host.keeper.statistics().cycles, 1u);
}

TEST(LiveWorlds, TheirClockStandsWheneverTheyAreNotReady) {
  LiveWorld world(1);
  FakeHost host(world, {});
  const auto goesOn = [&] {
    const std::uint64_t looks = host.keeper.statistics().cycles;
    do {
      host.keeper.runOnce();
    } while (world.ready && host.keeper.statistics().cycles == looks);
    const Timestamp wall = server::wallTime();
    return host.keeper.clock().at(wall + 1'000'000) - host.keeper.clock().at(wall);
  };
  for (int time = 0; time < 3; ++time) {
    world.ready = true;
    EXPECT_EQ(goesOn(), 1'000'000) << time;
    world.ready = false;
    EXPECT_EQ(goesOn(), 0) << time;
  }
}

// --- talk

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
  EXPECT_EQ(host.count(1, "ERR limit that is too much talk for all who hear it; say it again in "),
            1u);
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

// Who gets a turn when: conversations without sockets, so that nothing depends on how fast anybody
// is.
#include <gtest/gtest.h>

#include <algorithm>

#include "Await.hpp"
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
  ASSERT_TRUE(comesTrue("the first replies are there", [&] {
    if (!host.backlog.empty() && host.count(1) == 0) host.giveTurns();
    return host.backlog.empty() || host.count(1) > 0;
  }));
  honest.receive("STATUS\n");  // behind 60 orders of the other, as far as time goes
  host.keeper.runOnce();
  host.runTasks();
  const auto place = std::find_if(host.told.begin(), host.told.end(),
                                  [](const auto& line) { return line.first == 2; });
  ASSERT_NE(place, host.told.end());
  EXPECT_LE(place - host.told.begin(), 2);
}

TEST(Turns, RepliesToWhatCameTogetherLeaveTogether) {
  CountingWorld world;
  FakeHost host(world, lockstepConfig());
  auto [client, outlet] = host.join();
  const int before = outlet.pieces;
  client.receive(repeated("TIME", 5));
  EXPECT_GE(host.count(1, "OK TIME"), 1u);
  EXPECT_EQ(outlet.pieces - before, 1);
}

TEST(Turns, RepliesToOrdersThatWereExecutedTogetherLeaveTogether) {
  for (std::size_t orders = 1; orders <= 6; ++orders) {
    CountingWorld world;
    FakeHost host(world, lockstepConfig());
    auto [client, outlet] = host.join();
    client.receive(repeated("STATUS", static_cast<int>(orders)));
    host.giveAllTurns();  // however slow this computer is
    const int before = outlet.pieces;
    ASSERT_TRUE(comesTrue("all orders are executed", [&] {
      host.keeper.runOnce();
      return host.tasks.size() >= orders;
    }));
    host.runTasks();
    EXPECT_EQ(host.count(1, "OK STATUS"), orders);
    EXPECT_EQ(outlet.pieces - before, 1) << orders;
    EXPECT_FALSE(outlet.hasMore) << orders << ": the last one was not sent";
  }
}

TEST(Turns, NoReplyWaitsForThoseBehindIt) {
  CountingWorld world;
  FakeHost host(world, lockstepConfig());
  auto [client, outlet] = host.join();
  auto [other, outletOfOther] = host.join();
  other.receive("LOCKSTEP on\n");  // and it never says NEXT
  client.receive("LOCKSTEP on\n");
  host.settle();
  client.receive("STATUS\nNEXT\n");
  host.settle();
  EXPECT_TRUE(client.isWaiting());
  EXPECT_EQ(host.count(1, "OK STATUS"), 1u);
  EXPECT_FALSE(outlet.hasMore) << "it was not sent";
}

TEST(Turns, NothingIsDoneForWhoHasSaidByeOrWasDismissed) {
  for (const std::string end : {"BYE\n", "\x01\n\x01\n"}) {
    CountingWorld world;
    BoardConfig config = lockstepConfig();
    config.limits.errors = 2;
    FakeHost host(world, config);
    auto [anna, outlet] = host.join();
    auto [bert, outletOfBert] = host.join();
    anna.receive("SAY one\n" + end + "SAY two\n");
    host.settle();
    EXPECT_TRUE(anna.isOver());
    while (bert.hearOn()) {
    }
    EXPECT_EQ(host.count(2, "* SAY client=1 name=guest one"), 1u);
    EXPECT_EQ(host.count(2, "* SAY"), 1u);
  }
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
  host.giveAllTurns();
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
  client.receive("CREATE r\n" + kAnyRobot + ".\n");
  host.giveAllTurns();  // however slow this computer is
  // The file is read, no order was given yet.
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
  viewer.receive("SUBSCRIBE robot=1\nUNSUBSCRIBE robot=1\nSUBSCRIBE robot=2\n");
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
  void reset(std::optional<std::uint64_t>) override { ++resets; }
  bool ready = true;
  int resets = 0;

 private:
  Timestamp period_;
};

TEST(LiveWorlds, AreLookedAtOnceAPeriod) {
  LiveWorld world(3'600'000'000);
  FakeHost host(world, {});
  for (int i = 0; i < 5; ++i) host.keeper.runOnce();
  EXPECT_EQ(host.keeper.statistics().cycles, 1u);
}

TEST(LiveWorlds, TheirTimeIsNobodysToChange) {
  LiveWorld world(3'600'000'000);
  BoardConfig config;
  config.control = {"*"};
  FakeHost host(world, config);
  auto [olga, outlet] = host.join("operator");
  for (const char* line : {"PAUSE", "RESUME", "STEP", "SPEED 2", "RESET", "LOCKSTEP on"}) {
    host.told.clear();
    olga.receive(std::string(line) + "\n");
    host.settle();
    EXPECT_EQ(host.count(1, "ERR live this is a running robot: its time can't be "), 1u) << line;
  }
  EXPECT_EQ(world.resets, 0);
  EXPECT_TRUE(host.keeper.stateText() == "running") << host.keeper.stateText();
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

// --- worlds in real time

TEST(RealTime, AChangeOfSpeedCountsFromThenOn) {
  CountingWorld world;
  FakeHost host(world, {});
  host.keeper.setSpeed(0.0);  // as fast as possible
  for (int i = 0; i < 1000; ++i) host.keeper.runOnce();
  ASSERT_EQ(world.now(), 10'000'000);
  host.keeper.setSpeed(0.001);
  host.keeper.runOnce();  // a cycle begins where the clock stands
  EXPECT_EQ(world.now(), 10'010'000);
  for (int i = 0; i < 10; ++i) host.keeper.runOnce();  // the next one is due in 10 s
  EXPECT_EQ(world.now(), 10'010'000);
}

/// Its time can be set back: to the board this is as if the computer had slept for so long.
class SleptWorld : public CountingWorld {
 public:
  ~SleptWorld() override = default;
  Timestamp now() const override { return CountingWorld::now() - slept; }
  Timestamp slept = 0;  ///< [us]
};

TEST(RealTime, CyclesThatTheComputerSleptThroughAreMissedOnceAndNotCaughtUp) {
  for (const double speed : {1.0, 4.0, 0.25}) {
    SleptWorld world;
    FakeHost host(world, {});
    host.keeper.setSpeed(speed);
    host.keeper.runOnce();  // a cycle of 10 ms
    ASSERT_EQ(world.now(), 10'000);
    const std::uint64_t before = host.keeper.statistics().missedCycles;
    world.slept = 1'000'000'000'000;  // 10^8 cycles
    host.keeper.runOnce();
    const double missed = static_cast<double>(host.keeper.statistics().missedCycles - before);
    EXPECT_NEAR(missed, 1e8, 1e6) << speed << ": whatever else this computer has to do";
    EXPECT_EQ(host.keeper.statistics().cycles, 2u) << "it goes on from there";
    host.keeper.runOnce();
    EXPECT_NEAR(static_cast<double>(host.keeper.statistics().missedCycles - before), 1e8, 1e6)
        << speed << ": not once more";
  }
}

TEST(RealTime, AWorldThatStartsOverHasNoSpeedBackwards) {
  SleptWorld world;
  world.slept = -3'600'000'000;  // an hour has gone by
  FakeHost host(world, {});
  host.keeper.setSpeed(0.0);  // as fast as possible
  host.keeper.runOnce();
  world.slept = 0;
  host.keeper.runOnce();
  EXPECT_EQ(host.keeper.paceText(), " speed=0 achieved=0") << "a second has not gone by";
}

// --- readings

TEST(Readings, OfARobotWithOneFeatureOrInAnotherOrderAreThereToo) {
  const SensorId first{"a", "b", "c"};
  const SensorId second{"d", "e", "f"};
  const SensorId unknown{"x", "y", "z"};
  const auto written = [](const std::vector<SensorId>& features,
                          const std::vector<SensorId>& frame) {
    std::vector<ServedFeature> served;
    for (const SensorId& id : features) served.push_back({id, "", {}});
    server::RobotReadings readings(1, "robot", served);
    std::vector<Message> messages;
    for (const SensorId& id : frame) messages.push_back({7, id, {9}});
    readings.publish(messages);
    std::vector<std::uint64_t> sent;
    server::Output output;
    readings.write({}, sent, output);
    return output.text();
  };
  EXPECT_EQ(written({first}, {first}), "7 a/b/c 1 9\n");
  EXPECT_EQ(written({first}, {unknown, first, unknown}), "7 a/b/c 1 9\n");
  EXPECT_EQ(written({first, second}, {second, unknown, first}), "7 a/b/c 1 9\n7 d/e/f 1 9\n");
  EXPECT_EQ(written({first, second}, {second}), "7 d/e/f 1 9\n");
  EXPECT_EQ(written({}, {first}), "");
}

}  // namespace
}  // namespace ortung::test

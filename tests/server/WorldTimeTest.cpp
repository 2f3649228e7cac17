// The world's time beside the computer's.
#include <gtest/gtest.h>

#include <chrono>

#include "Await.hpp"
#include "CountingWorld.hpp"
#include "RunningBoard.hpp"
#include "TestClient.hpp"

namespace ortung::test {
namespace {

using std::chrono::steady_clock;

/// A cycle takes three times as long as it should.
class SlowWorld : public CountingWorld {
 public:
  ~SlowWorld() override = default;
  void step() override {
    const auto end = steady_clock::now() + std::chrono::microseconds(3 * cycle);
    while (steady_clock::now() < end) {
    }
    CountingWorld::step();
  }
};

/// What the board says once the world has made so many cycles.
std::string statusAfter(int cycles, const RunningBoard& board) {
  TestClient client(board.port());
  client.ask("HELLO ortung/1");
  std::string status;
  EXPECT_TRUE(comesTrue("there were " + std::to_string(cycles) + " cycles", [&] {
    status = client.ask("STATUS");
    return std::stoi(valueOf(status, "cycles")) >= cycles;
  }));
  return status;
}

TEST(WorldTime, CyclesThatBeginTooLateAreCounted) {
  SlowWorld world;
  world.cycle = 1000;
  const RunningBoard board(world, {});
  const std::string status = statusAfter(20, board);
  // Each one is 2 ms behind the one before it; the first two may still be in time.
  EXPECT_GE(std::stoi(valueOf(status, "missed")), 18);
}

TEST(WorldTime, NothingIsMissedByAWorldThatIsInTime) {
  CountingWorld world;
  world.cycle = 1'000'000'000;  // so that no computer is too slow
  const RunningBoard board(world, {});
  EXPECT_EQ(valueOf(statusAfter(1, board), "missed"), "0");
}

TEST(WorldTime, NothingIsMissedByAWorldThatMayTakeItsTime) {
  SlowWorld world;
  world.cycle = 1000;
  BoardConfig config;
  config.pace = Pace::kFree;
  const RunningBoard board(world, config);
  EXPECT_EQ(valueOf(statusAfter(20, board), "missed"), "0");
}

TEST(WorldTime, TheClockRunsAgainAfterAPauseWithinACycle) {
  CountingWorld world;
  world.cycle = 1'000'000'000;  // so that all of this happens within the second one
  BoardConfig config;
  config.control = {"*"};
  const RunningBoard board(world, config);
  TestClient client(board.port());
  client.ask("HELLO ortung/1");
  ASSERT_TRUE(comesTrue("there was one cycle",
                        [&] { return valueOf(client.ask("STATUS"), "cycles") == "1"; }));
  const std::string paused = valueOf(client.ask("PAUSE"), "now");
  EXPECT_EQ(paused, "1000000000");
  for (int i = 0; i < 100; ++i) EXPECT_EQ(valueOf(client.ask("TIME"), "sent"), paused);
  EXPECT_TRUE(client.ask("RESUME").starts_with("OK RESUME"));
  EXPECT_EQ(valueOf(client.ask("STATUS"), "cycles"), "1");
  const auto sent = [&] { return std::stoll(valueOf(client.ask("TIME"), "sent")); };
  const long long first = sent();
  long long last = first;
  for (int i = 0; i < 1000 && last == first; ++i) last = sent();
  EXPECT_GT(last, first);
}

}  // namespace
}  // namespace ortung::test

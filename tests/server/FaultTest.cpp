// Clients that die, talk nonsense, or come and go.
#include <gtest/gtest.h>
#include <malloc.h>

#include <filesystem>
#include <iterator>

#include "Await.hpp"
#include "CountingWorld.hpp"
#include "RunningBoard.hpp"
#include "TestClient.hpp"
#include "ortung/base/Random.hpp"

namespace ortung::test {
namespace {

std::size_t openFiles() {
  return static_cast<std::size_t>(
      std::distance(std::filesystem::directory_iterator("/proc/self/fd"), {}));
}

/// Waits until the field is as it should be, which another client sees.
void waitForRobots(TestClient& observer, const std::string& count) {
  EXPECT_TRUE(comesTrue("there are as many robots: " + count,
                        [&] { return valueOf(observer.ask("STATUS"), "robots") == count; }));
}

TEST(Faults, AClientKilledInTheMiddleOfALineTakesItsRobotWithIt) {
  CountingWorld world;
  const RunningBoard board(world, {});
  TestClient observer(board.port());
  observer.ask("HELLO ortung/1");
  TestClient client(board.port());
  client.join(kAnyRobot);
  waitForRobots(observer, "1");
  client.send("VELOCITY v_m_s=0.");
  client.kill();
  waitForRobots(observer, "0");
}

TEST(Faults, AClientKilledInTheMiddleOfARobotFileLeavesNothing) {
  CountingWorld world;
  const RunningBoard board(world, {});
  TestClient observer(board.port());
  observer.ask("HELLO ortung/1");
  {
    TestClient client(board.port());
    client.ask("HELLO ortung/1");
    client.send("CREATE half\n[[sensor]]\nplug");
    client.kill();
  }
  EXPECT_TRUE(comesTrue("only the observer is left",
                        [&] { return valueOf(observer.ask("STATUS"), "clients") == "1"; }));
  EXPECT_EQ(valueOf(observer.ask("STATUS"), "robots"), "0");
}

TEST(Faults, AScriptThatEndsItsInputIsAnsweredToTheEnd) {
  CountingWorld world;
  const RunningBoard board(world, {});
  for (const std::string end : {"", "BYE\n"}) {
    TestClient script(board.port());
    script.send("HELLO ortung/1\nCREATE a\n" + std::string(kAnyRobot) + ".\nSTATUS\nFLY\n" + end);
    script.endInput();
    const std::string all = script.rest();
    EXPECT_NE(all.find("OK HELLO"), std::string::npos) << all;
    EXPECT_NE(all.find("OK CREATE"), std::string::npos) << all;
    EXPECT_NE(all.find("OK STATUS"), std::string::npos) << all;
    EXPECT_NE(all.find("ERR unknown"), std::string::npos) << all;
  }
}

TEST(Faults, AClientKilledInLockstepDoesNotHoldTheOthers) {
  CountingWorld world;
  const RunningBoard board(world, lockstepConfig());
  TestClient client(board.port());
  client.join(kAnyRobot);
  client.ask("LOCKSTEP on");
  TestClient waiting(board.port());  // dies while it waits for its cycle
  waiting.join(kAnyRobot);
  waiting.ask("LOCKSTEP on");
  waiting.send("NEXT cycles=1000000\n");
  TestClient idle(board.port());  // dies before it asks for one
  idle.join(kAnyRobot);
  idle.ask("LOCKSTEP on");
  client.send("NEXT cycles=5\n");
  waiting.kill();
  idle.kill();
  EXPECT_EQ(client.line(), "OK NEXT robot=1 now=50000 lines=1");
}

TEST(Faults, TheServersEndIsToldToThoseWhoWait) {
  CountingWorld world;
  auto board = std::make_unique<RunningBoard>(world, lockstepConfig());
  TestClient client(board->port());
  client.join(kAnyRobot);
  client.ask("LOCKSTEP on");
  TestClient other(board->port());
  other.join(kAnyRobot);
  other.ask("LOCKSTEP on");
  client.send("NEXT\n");
  board.reset();
  EXPECT_EQ(client.line(), "* BYE the server ends");
  EXPECT_EQ(client.line(), "(closed)");
}

/// A line of a session with bytes changed, left out or put in; never longer than a line may be.
std::string damaged(Random& random) {
  static const std::vector<std::string> kLines = {
      "HELLO ortung/1 name=anna token=x role=player",
      "#1 VELOCITY v_m_s=0.5 w_rad_s=-0.25 robot=1",
      "#2 CREATE r x_m=1 y_m=2 theta_deg=90 drive=wander",
      ".",
      "[[sensor]]",
      "plugin = \"odometry\"",
      "MOTION 1 2 3 robot=2",
      "NEXT cycles=3 LMS200/LRF/*",
      "SUBSCRIBE period_s=0.01 */*/*",
      "READ form=binary",
      "LOCKSTEP on",
      "LIST robots",
      "DESCRIBE robot robot=1",
      "SAY hello",
      "MANIPULATOR kicker 1",
      "TIME",
      "HELP",
      "SCORE left=1",
      "REMOVE",
      "STEP cycles=9"};
  std::string line = kLines[random.below(kLines.size())];
  for (std::uint64_t changes = random.below(6); changes > 0 && !line.empty(); --changes) {
    const auto place = random.below(line.size());
    switch (random.below(4)) {
      case 0:
        line[place] = static_cast<char>(random.below(256));
        break;
      case 1:
        line.erase(place, 1 + random.below(5));
        break;
      case 2:
        line.insert(place, random.below(40), static_cast<char>(random.below(256)));
        break;
      default:
        line += " " + kLines[random.below(kLines.size())];
    }
  }
  return line;
}

TEST(Faults, TenThousandDamagedLinesDoNoHarm) {
  CountingWorld world;
  BoardConfig config;
  config.limits.errors = 1'000'000;
  const RunningBoard board(world, config);
  Random random(2026);
  for (int session = 0; session < 10; ++session) {
    TestClient client(board.port());
    client.join(kAnyRobot);
    std::string all;
    for (int i = 0; i < 1000; ++i) all += damaged(random) + "\n";
    std::thread reader([&] { client.rest(); });
    client.send(all + "\n.\n.\nLOCKSTEP off\nBYE\n");
    reader.join();
  }
  TestClient healthy(board.port());
  EXPECT_TRUE(healthy.join(kAnyRobot).starts_with("OK CREATE"));
}

TEST(Faults, FiveHundredVisitsLeaveNeitherFilesNorMemoryBehind) {
  CountingWorld world;
  const RunningBoard board(world, {});
  const auto visit = [&](int times) {
    for (int i = 0; i < times; ++i) {
      TestClient client(board.port());
      client.join(kAnyRobot);
      client.ask("SUBSCRIBE");
      client.ask("READ");
      if (i % 2 == 0) client.kill();
    }
    EXPECT_TRUE(comesTrue("no client is left", [&] { return board.statistics().clients == 0; }));
  };
  visit(100);  // buffers and tables have their size
  const auto memory = mallinfo2().uordblks;
  const std::size_t files = openFiles();
  visit(500);
  // Sessions are swept up four times a second.
  EXPECT_TRUE(comesTrue("their files are closed", [&] { return openFiles() <= files; }));
  constexpr std::size_t kLess = 100 * 1024;  // 200 bytes a visit would show
  EXPECT_LT(mallinfo2().uordblks, memory + kLess);
  EXPECT_EQ(board.statistics().robots, 0u);
}

}  // namespace
}  // namespace ortung::test

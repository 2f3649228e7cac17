// Hostile clients beside honest ones: whatever those do, these lose nothing. How long they wait is
// measured by tests/bench/HostileBench.cpp.
#include <gtest/gtest.h>

#include <atomic>

#include "CountingWorld.hpp"
#include "RunningBoard.hpp"
#include "TestClient.hpp"

namespace ortung::test {
namespace {

std::string repeated(const std::string& text, int times) {
  std::string all;
  for (int i = 0; i < times; ++i) all += text;
  return all;
}

/// Sends a text over and over; whoever is thrown out comes back.
class Attacker {
 public:
  Attacker(std::uint16_t port, std::string text)
      : thread_([this, port, text = std::move(text)] {
          while (goesOn_) {
            TestClient client(port);
            client.send("HELLO ortung/1 name=attacker\nCREATE a\n" + kAnyRobot + ".\n");
            while (goesOn_ && client.offer(text)) {
            }
          }
        }) {}
  ~Attacker() {
    goesOn_ = false;
    thread_.join();
  }
  Attacker(const Attacker&) = delete;
  Attacker& operator=(const Attacker&) = delete;

 private:
  std::atomic<bool> goesOn_{true};
  std::thread thread_;
};

std::vector<std::string> attacks() {
  std::string absurd = "SUBSCRIBE";
  for (int i = 0; i < 60; ++i) absurd += " a" + std::to_string(i) + "/*/*";
  return {repeated("SAY hi\n", 200),
          "SAY " + std::string(60'000, 'x') + "\n",
          "SAY " + std::string(4'000, 'x') + "\n",
          repeated("VELOCITY v_m_s=0.1\n", 200) + repeated("TIME\nREAD\n", 200),
          absurd + " */*/*\n",
          "VELOCITY v_m_",
          std::string(60'000, 'x') + "\n",
          repeated("\x01\xff{]\n", 200)};
}

/// Lets the world go on by cycles of its own until @p cycles were read, and expects all of them.
void expectAllReadings(TestClient& honest, int cycles) {
  const auto next = [&] {  // what others say may come between
    std::string line = honest.line();
    while (line.starts_with("* SAY") || line.starts_with("* LOST")) line = honest.line();
    return line;
  };
  for (int cycle = 0; cycle < cycles; ++cycle) {
    honest.send("NEXT counter/*/*\n");
    const std::string head = next();
    ASSERT_TRUE(head.starts_with("OK NEXT")) << head;
    ASSERT_EQ(valueOf(head, "lines"), "1") << head;
    const std::string stamp = std::to_string(cycle * 10'000) + " ";
    const std::string reading = next();
    ASSERT_TRUE(reading.starts_with(stamp)) << reading << " in cycle " << cycle;
  }
}

void expectNobodyIsHarmed(const std::vector<std::string>& hostile, int cycles) {
  CountingWorld world;
  const RunningBoard board(world, lockstepConfig());
  TestClient anna(board.port());
  TestClient bert(board.port());
  for (TestClient* honest : {&anna, &bert}) {
    honest->join(kAnyRobot);
    honest->lineWith("OK LOCKSTEP", "LOCKSTEP on\n");
  }
  std::vector<std::unique_ptr<Attacker>> attackers;
  for (const std::string& text : hostile)
    attackers.push_back(std::make_unique<Attacker>(board.port(), text));
  std::thread other([&] { expectAllReadings(bert, cycles); });
  expectAllReadings(anna, cycles);
  other.join();
}

TEST(Hostile, EachByItselfHarmsNobody) {
  for (const std::string& text : attacks()) expectNobodyIsHarmed({text}, 30);
}

TEST(Hostile, AllAtOnceHarmNobody) { expectNobodyIsHarmed(attacks(), 100); }

TEST(Hostile, WhoTalksTooMuchIsToldAndThenThrownOut) {
  CountingWorld world;
  BoardConfig config;
  config.limits.talkLines = 5.0;  // so few that they are used up however slowly lines are read
  config.limits.errors = 20;
  const RunningBoard board(world, config);
  TestClient listener(board.port());
  listener.ask("HELLO ortung/1");
  TestClient talker(board.port());
  talker.ask("HELLO ortung/1");
  talker.send(repeated("SAY hi\n", 5000));
  int said = 0;
  int refused = 0;
  std::string line = talker.line();
  for (; !line.starts_with("* ") && line != "(closed)"; line = talker.line()) {
    said += line == "OK SAY" ? 1 : 0;
    refused += line.starts_with("ERR limit that is too much talk") ? 1 : 0;
  }
  EXPECT_EQ(line, "* ERR errors too many in a row");
  EXPECT_GE(said, 2);  // a fifth of a second's talk is there at the beginning, and one more is debt
  EXPECT_LT(said, 500);
  EXPECT_GE(refused, 20);
  for (int i = 0; i < said; ++i) EXPECT_EQ(listener.line(), "* SAY client=2 name=guest hi");
  EXPECT_TRUE(listener.ask("STATUS").starts_with("OK STATUS"));
}

TEST(Hostile, InputIsNotReadWithoutBound) {
  CountingWorld world;
  const RunningBoard board(world, lockstepConfig());
  TestClient idle(board.port());  // the world waits for it
  idle.join(kAnyRobot);
  idle.ask("LOCKSTEP on");
  TestClient client(board.port());
  client.join(kAnyRobot);
  client.ask("LOCKSTEP on");
  client.send("NEXT\n");
  // What comes behind it has to wait: in the network, not in the server's memory.
  constexpr std::size_t kMuch = 100u << 20;
  const std::string piece = repeated("TIME\n", 10'000);
  std::size_t sent = 0;
  while (sent < kMuch && client.offer(piece)) sent += piece.size();
  EXPECT_LT(sent, kMuch);
}

}  // namespace
}  // namespace ortung::test

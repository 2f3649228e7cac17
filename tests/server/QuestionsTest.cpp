// Questions that take long: who asks anew before it is answered, and who waits for whom.
#include <gtest/gtest.h>

#include <vector>

#include "FakeHost.hpp"
#include "RunningBoard.hpp"

namespace ortung::test {
namespace {

/// A world that notes where it was taken.
class SoughtWorld final : public CountingWorld {
 public:
  void seek(Timestamp stamp) override { sought.push_back(toSeconds(stamp)); }
  std::vector<double> sought;
};

/// Answers a slow question with its words; notes them, and does what a test wants meanwhile.
struct Thinking {
  BoardConfig config() {
    BoardConfig config = controlledConfig();
    for (const bool isReplaceable : {true, false})
      config.commands.push_back({.name = isReplaceable ? "THINK" : "BROOD",
                                 .help = "",
                                 .handle =
                                     [this](const BoardCommand::Call& call) {
                                       thought += call.words.front();
                                       if (meanwhile) std::exchange(meanwhile, {})();
                                       return BoardCommand::Reply{call.words.front()};
                                     },
                                 .isSlow = true,
                                 .isReplaceable = isReplaceable});
    return config;
  }
  std::string thought;
  std::function<void()> meanwhile;
};

std::vector<std::string> toldTo(const FakeHost& host, server::ClientId client) {
  std::vector<std::string> lines;
  for (const auto& [who, line] : host.told)
    if (who == client) lines.push_back(line);
  return lines;
}

const std::string kSuperseded =
    " ERR superseded a newer one of the same command came before it was begun";

TEST(Questions, ANewerOneTakesThePlaceOfOneThatWaits) {
  CountingWorld world;
  Thinking thinking;
  FakeHost host(world, thinking.config());
  auto [client, outlet] = host.join();
  host.told.clear();
  client.receive("#1 THINK a\n#2 THINK b\n#3 THINK c\n#4 TIME\n");
  EXPECT_TRUE(host.told.empty()) << "told with the answer: asking anew is not answered at once";
  host.settle();
  const std::vector<std::string> lines = toldTo(host, 1);
  ASSERT_EQ(lines.size(), 4u);
  EXPECT_EQ(lines[0], "#1" + kSuperseded);
  EXPECT_EQ(lines[1], "#2" + kSuperseded);
  EXPECT_EQ(lines[2], "#3 OK THINK c");
  EXPECT_TRUE(lines[3].starts_with("#4 OK TIME"));
  EXPECT_EQ(thinking.thought, "c");
  EXPECT_FALSE(client.hasOpenRequests());
}

TEST(Questions, OneThatWasBegunIsAnswered) {
  CountingWorld world;
  Thinking thinking;
  FakeHost host(world, thinking.config());
  auto [joined, outlet] = host.join();
  server::Conversation& client = joined;
  host.told.clear();
  thinking.meanwhile = [&] { client.receive("#2 THINK b\n#3 THINK c\n"); };
  client.receive("#1 THINK a\n");
  host.settle();
  EXPECT_EQ(toldTo(host, 1),
            (std::vector<std::string>{"#1 OK THINK a", "#2" + kSuperseded, "#3 OK THINK c"}));
}

TEST(Questions, WhatIsAnotherCommandOrMoreThanAQuestionIsExecutedInItsOrder) {
  CountingWorld world;
  Thinking thinking;
  FakeHost host(world, thinking.config());
  auto [client, outlet] = host.join();
  host.told.clear();
  client.receive("#1 THINK a\n#2 BROOD b\n#3 BROOD c\n#4 THINK d\n\n#5 THINK e\n");
  host.settle();
  EXPECT_EQ(thinking.thought, "abcde") << "between the last two there is an empty line";
  EXPECT_EQ(host.count(1, "#"), 5u);
}

TEST(Questions, AskedAnewWithoutEndEndNoConnection) {
  CountingWorld world;
  Thinking thinking;
  FakeHost host(world, thinking.config());
  auto [client, outlet] = host.join();
  host.told.clear();
  std::string many;
  for (int i = 0; i < 1000; ++i) many += "THINK x\n";
  client.receive(many);
  host.settle();
  EXPECT_FALSE(client.isOver()) << "they are no errors of its";
  EXPECT_EQ(host.count(1), 1000u);
  const std::size_t thought = thinking.thought.size();
  EXPECT_GE(thought, 1000u / (1 + BoardLimits().orders)) << "no more than so many wait for one";
  EXPECT_LE(thought, 100u);
}

TEST(Questions, ARefusalComesBehindWhatItHasSuperseded) {
  SoughtWorld world;
  FakeHost host(world, controlledConfig());
  auto [client, outlet] = host.join("operator");
  host.told.clear();
  client.receive("#1 SEEK time_s=1\n#2 SEEK\n#3 SEEK time_s=3\n");
  host.settle();
  const std::vector<std::string> lines = toldTo(host, 1);
  ASSERT_EQ(lines.size(), 3u);
  EXPECT_EQ(lines[0], "#1" + kSuperseded);
  EXPECT_TRUE(lines[1].starts_with("#2 ERR syntax"));
  EXPECT_TRUE(lines[2].starts_with("#3 OK SEEK"));
  EXPECT_EQ(world.sought, std::vector<double>{3.0});
}

TEST(Questions, OfManyClientsEachHasItsNewestSeekDone) {
  SoughtWorld world;
  FakeHost host(world, controlledConfig());
  for (int i = 0; i < 3; ++i) host.join("operator");
  host.told.clear();
  for (int again = 0; again < 3; ++again)
    for (std::size_t i = 0; i < 3; ++i)
      host.clients[i]->receive("SEEK time_s=" + std::to_string(10 * again + int(i)) + "\n");
  host.settle();
  EXPECT_EQ(world.sought, (std::vector<double>{20.0, 21.0, 22.0}));
  for (server::ClientId client = 1; client <= 3; ++client) {
    EXPECT_EQ(host.count(client, "OK SEEK"), 1u);
    EXPECT_EQ(host.count(client, "ERR superseded"), 2u);
  }
}

TEST(Questions, OfWhoHasLeftAreForgotten) {
  SoughtWorld world;
  FakeHost host(world, controlledConfig());
  auto [client, outlet] = host.join("operator");
  client.receive("SEEK time_s=1\n");
  client.hangUp();
  host.settle();
  EXPECT_LE(world.sought.size(), 1u);
  EXPECT_FALSE(client.hasOpenRequests());
}

}  // namespace
}  // namespace ortung::test

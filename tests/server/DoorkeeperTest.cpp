// Who may come in, as whom, and how fast somebody may guess.
#include <gtest/gtest.h>

#include <chrono>
#include <mutex>

#include "Await.hpp"
#include "CountingWorld.hpp"
#include "Doorkeeper.hpp"
#include "Files.hpp"
#include "RunningBoard.hpp"
#include "TestClient.hpp"
#include "ortung/server/ControlToken.hpp"

namespace ortung::test {
namespace {

using server::Doorkeeper;

constexpr const char* kWrong = "* ERR token it is missing or wrong";

BoardConfig guardedConfig() {
  BoardConfig config;
  config.tokens = {{"*", "guesttoken1"}, {"boss", "bosstoken2"}, {"anna", "secret-of-anna"}};
  config.control = {"boss"};
  config.limits.refusal = 0.02;
  return config;
}

double secondsSince(std::chrono::steady_clock::time_point begin) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

TEST(Doorkeeper, TheTokenForAnyNameIsForNamesWithoutOneOfTheirOwn) {
  CountingWorld world;
  const RunningBoard board(world, guardedConfig());
  for (const char* hello :
       {"HELLO ortung/1 name=boss token=guesttoken1", "HELLO ortung/1 name=anna token=guesttoken1",
        "HELLO ortung/1 name=boss token=guesttoken1 role=viewer",
        "HELLO ortung/1 name=boss token=secret-of-anna",
        "HELLO ortung/1 name=bert token=secret-of-anna",
        "HELLO ortung/1 name=bert token=bosstoken2", "HELLO ortung/1 name=anna",
        "HELLO ortung/1 name=anna token=secret-of-ann",
        "HELLO ortung/1 token=", "HELLO ortung/1 name=* token=guesttoken"}) {
    TestClient client(board.port());
    const std::string reply = client.ask(hello);
    EXPECT_TRUE(reply == kWrong || reply.starts_with("ERR syntax")) << hello << ": " << reply;
  }
  const std::vector<std::pair<const char*, const char*>> welcome = {
      {"HELLO ortung/1 name=boss token=bosstoken2", "operator"},
      {"HELLO ortung/1 name=boss token=bosstoken2 role=viewer", "viewer"},
      {"HELLO ortung/1 name=anna token=secret-of-anna", "player"},
      {"HELLO ortung/1 name=Boss token=guesttoken1", "player"},  // another name
      {"HELLO ortung/1 token=guesttoken1", "player"}};
  for (const auto& [hello, role] : welcome)
    EXPECT_EQ(valueOf(TestClient(board.port()).ask(hello), "role"), role) << hello;
}

TEST(Doorkeeper, WhoMayControlNeedsATokenOfHisOwn) {
  CountingWorld world;
  BoardConfig config;
  config.tokens = {{"*", "guesttoken1"}};
  config.control = {"boss"};
  EXPECT_EQ(messageOf<std::invalid_argument>([&] { MessageBoard(world, config); }),
            "'boss' may control, but has no token of its own, and that of '*' does not let it in");
  config.control = {"*"};
  EXPECT_NO_THROW(MessageBoard(world, config));
  // Should such a name come through all the same, it is not let in.
  config.control = {"boss"};
  const Doorkeeper door(config);
  EXPECT_FALSE(door.isRight("boss", "guesttoken1"));
  EXPECT_TRUE(door.isRight("bert", "guesttoken1"));
}

TEST(Doorkeeper, TokensHaveAtLeastEightCharacters) {
  CountingWorld world;
  BoardConfig config;
  config.tokens = {{"*", "1234567"}};
  EXPECT_EQ(messageOf<std::invalid_argument>([&] { MessageBoard(world, config); }),
            "the token of '*' has less than 8 characters");
  config.tokens = {{"*", "12345678"}};
  EXPECT_NO_THROW(MessageBoard(world, config));
}

TEST(Doorkeeper, AWrongTokenIsAnsweredLateAndHoldsUpNobodyElse) {
  CountingWorld world;
  BoardConfig config = guardedConfig();
  config.limits.refusal = 0.3;
  const RunningBoard board(world, config);
  TestClient other(board.port());
  other.ask("HELLO ortung/1 token=guesttoken1");
  const auto begin = std::chrono::steady_clock::now();
  TestClient guesser(board.port());
  guesser.send("HELLO ortung/1 token=guesttoken2\nHELLO ortung/1 token=guesttoken1\n");
  // While it waits, the others are answered: the server has nothing to do for it.
  do EXPECT_TRUE(other.ask("TIME").starts_with("OK TIME"));
  while (secondsSince(begin) < 0.2);
  EXPECT_EQ(guesser.line(), kWrong);
  EXPECT_GE(secondsSince(begin), 0.3);
  EXPECT_EQ(guesser.line(), "(closed)");
}

TEST(Doorkeeper, AfterAWrongTokenNewConnectionsFromThereAreLookedAtLater) {
  CountingWorld world;
  BoardConfig config = guardedConfig();
  config.limits.refusal = 0.2;
  const RunningBoard board(world, config);
  EXPECT_EQ(TestClient(board.port()).ask("HELLO ortung/1 token=nonsense"), kWrong);
  // Many at a time: none is looked at at once, so who hangs up learns nothing.
  const auto begin = std::chrono::steady_clock::now();
  std::vector<std::unique_ptr<TestClient>> clients;
  for (int i = 0; i < 10; ++i) {
    clients.push_back(std::make_unique<TestClient>(board.port()));
    clients.back()->send("#x HELLO ortung/1 token=" +
                         std::string(i % 2 == 0 ? "guesttoken1" : "guesttoken3") + "\nTIME\n");
  }
  for (int i = 0; i < 10; ++i) {
    const std::string reply = clients[static_cast<std::size_t>(i)]->line();
    EXPECT_GE(secondsSince(begin), 0.2);
    if (i % 2 == 0)
      EXPECT_TRUE(reply.starts_with("#x OK HELLO")) << reply;
    else
      EXPECT_EQ(reply, kWrong);
  }
  EXPECT_TRUE(clients[0]->line().starts_with("OK TIME"));
}

TEST(Doorkeeper, WhoHangsUpWhileItWaitsLeavesNothingBehind) {
  CountingWorld world;
  const RunningBoard board(world, guardedConfig());
  EXPECT_EQ(TestClient(board.port()).ask("HELLO ortung/1 token=nonsense"), kWrong);
  for (int i = 0; i < 20; ++i) {
    TestClient client(board.port());
    client.send("HELLO ortung/1 token=guesttoken1\n");
    if (i % 2 == 0) client.kill();
  }
  ASSERT_TRUE(comesTrue("no client is left", [&] { return board.statistics().clients == 0; }));
  EXPECT_TRUE(
      TestClient(board.port()).ask("HELLO ortung/1 token=guesttoken1").starts_with("OK HELLO"));
}

TEST(Doorkeeper, RefusalsAreLoggedAtMostOnceASecondAndForgottenAfterAMinute) {
  BoardConfig config = guardedConfig();
  std::vector<std::string> log;
  config.log = [&](const std::string& text) { log.push_back(text); };
  Doorkeeper door(config);
  constexpr Timestamp kSecond = 1'000'000;
  const Timestamp begin = 7 * kSecond;
  EXPECT_EQ(door.pause("10.0.0.1", begin), 0);
  for (int i = 0; i < 50; ++i) door.refuse("10.0.0.1", "boss", begin + i * 1000);
  door.refuse("10.0.0.2", "anna", begin + kSecond);
  EXPECT_EQ(log, (std::vector<std::string>{
                     "a client at 10.0.0.1 that calls itself 'boss' has a wrong token",
                     "a client at 10.0.0.2 that calls itself 'anna' has a wrong token; so had 49 "
                     "more since the last note"}));
  EXPECT_EQ(door.pause("10.0.0.1", begin + 30 * kSecond), 20'000);
  EXPECT_EQ(door.pause("10.0.0.3", begin + 30 * kSecond), 0);
  EXPECT_EQ(door.pause("10.0.0.1", begin + 61 * kSecond), 0);
  for (int i = 0; i < 5000; ++i)  // from so many places: then all have to wait
    door.refuse("place " + std::to_string(i), "boss", begin);
  EXPECT_EQ(door.pause("10.0.0.3", begin), 20'000);
}

TEST(Doorkeeper, TokensAreComparedWhole) {
  using server::isSameInConstantTime;
  EXPECT_TRUE(isSameInConstantTime("abcd", "abcd"));
  for (const char* other : {"", "abc", "abcde", "abcdabcd", "bbcd", "abce"})
    EXPECT_FALSE(isSameInConstantTime("abcd", other)) << other;
  EXPECT_FALSE(isSameInConstantTime("", "a"));
}

TEST(Doorkeeper, OnlyATokenOfWhoMayControlIsOneOfControl) {
  BoardConfig config;
  config.tokens = {{"boss", "secret"}, {"guest", "other"}, {"*", "all"}, {"view", ""}};
  config.control = {"boss", "view", "*"};
  EXPECT_TRUE(isControlToken(config, "secret"));
  for (const char* token : {"", "other", "all", "secre", "secrets"})
    EXPECT_FALSE(isControlToken(config, token)) << token;
}

}  // namespace
}  // namespace ortung::test

// Who comes to the board's port and has not shown yet what it speaks, who is refused, and who comes
// by another way.
#include <gtest/gtest.h>

#include <functional>
#include <memory>
#include <mutex>
#include <vector>

#include "CountingWorld.hpp"
#include "RunningBoard.hpp"
#include "TestClient.hpp"

namespace ortung::test {
namespace {

const std::string kHello = "HELLO ortung/1";
constexpr const char* kOther = "127.0.0.2";

BoardConfig fewPlaces(std::size_t all, std::size_t ofAddress) {
  BoardConfig config;
  config.limits.sessions = all;
  config.limits.sessionsOfAddress = ofAddress;
  return config;
}

/// Says HELLO again and again until it is let in, or refused for too long.
std::string helloAtLast(std::uint16_t port, const std::string& from = "127.0.0.1") {
  constexpr int kMost = 10'000;
  std::string reply;
  for (int i = 0; i < kMost && !reply.starts_with("OK"); ++i)
    reply = TestClient(port, from).ask(kHello);
  return reply;
}

using Strangers = std::vector<std::unique_ptr<TestClient>>;
void add(Strangers& strangers, int number, std::uint16_t port, const std::string& from,
         const std::string& text) {
  for (int i = 0; i < number; ++i) {
    strangers.push_back(std::make_unique<TestClient>(port, from));
    strangers.back()->send(text);
  }
}

TEST(Entrance, StrangersTakeNoClientsPlace) {
  CountingWorld world;
  const RunningBoard board(world, fewPlaces(4, 2));
  Strangers strangers;
  for (const char* from : {"127.0.0.1", kOther, "127.0.0.3"})
    for (const char* text : {"GET / HTTP/1.1\r\nHo", "HE", ""})
      add(strangers, 4, board.port(), from, text);
  for (const char* from : {"127.0.0.1", kOther}) {
    TestClient first(board.port(), from);
    EXPECT_TRUE(first.ask(kHello).starts_with("OK HELLO"));
    TestClient page(board.port(), from);
    page.send("GET / HTTP/1.1\r\n\r\n");
    EXPECT_TRUE(page.rest().starts_with("HTTP/1.1 501 "));
  }
}

TEST(Entrance, TheOldestStrangerGoesOfTheComputerThatHasTheMost) {
  CountingWorld world;
  BoardConfig config = fewPlaces(4, 3);
  config.limits.head = 30.0;
  const RunningBoard board(world, config);
  Strangers many;
  Strangers others;
  const std::string half = "GET / HTTP/1.1\r\n";
  add(many, 3, board.port(), kOther, half);
  add(others, 1, board.port(), "127.0.0.3", half);
  add(others, 1, board.port(), "127.0.0.4", half);  // there are four already
  EXPECT_EQ(many[0]->rest(), "");
  add(many, 2, board.port(), kOther, half);
  EXPECT_EQ(many[1]->rest(), "");
  for (const auto& other : others) {
    other->send("\r\n");
    EXPECT_TRUE(other->rest().starts_with("HTTP/1.1 501 "));
  }
}

TEST(Entrance, WhoIsRefusedTakesNoClientsPlace) {
  CountingWorld world;
  const RunningBoard board(world, fewPlaces(1, 1));
  Strangers refused;
  {
    TestClient client(board.port());
    EXPECT_TRUE(client.ask(kHello).starts_with("OK HELLO"));
    for (int i = 0; i < 5; ++i) {
      refused.push_back(std::make_unique<TestClient>(board.port()));
      EXPECT_EQ(refused.back()->ask(kHello), "* ERR limit there are 1 clients already");
    }
  }
  EXPECT_TRUE(helloAtLast(board.port()).starts_with("OK HELLO"));
}

TEST(Entrance, WhoDoesNotSayHelloGivesItsPlaceToWhoDoes) {
  CountingWorld world;
  const RunningBoard board(world, fewPlaces(3, 2));
  TestClient first(board.port());
  EXPECT_TRUE(first.ask(kHello).starts_with("OK HELLO"));
  Strangers talkers;
  for (const char* from : {"127.0.0.1", kOther, kOther}) {
    talkers.push_back(std::make_unique<TestClient>(board.port(), from));
    EXPECT_TRUE(talkers.back()->ask("TIME").starts_with("ERR hello"));
  }
  EXPECT_EQ(talkers[0]->line(), "(closed)") << "the oldest, when there were three";
  TestClient second(board.port());
  EXPECT_TRUE(second.ask(kHello).starts_with("OK HELLO"));
  TestClient third(board.port(), kOther);
  EXPECT_TRUE(third.ask(kHello).starts_with("OK HELLO"));
  EXPECT_TRUE(first.ask("STATUS").starts_with("OK STATUS"));
  TestClient fourth(board.port(), kOther);
  EXPECT_EQ(fourth.ask(kHello), "* ERR limit there are 3 clients already");
}

TEST(Entrance, WhoKeepsSilentIsToldAndTakesNoClientsPlace) {
  CountingWorld world;
  BoardConfig config = fewPlaces(1, 1);
  config.limits.handshake = 0.05;
  const RunningBoard board(world, config);
  TestClient silent(board.port());
  EXPECT_EQ(silent.line(), "* ERR hello it did not come within 0 s");
  EXPECT_TRUE(helloAtLast(board.port()).starts_with("OK HELLO"));
}

/// A board whose visitors over HTTP get a connection to it, which the test takes over.
class JoiningTest : public testing::Test {
 protected:
  JoiningTest() {
    config_.http = [this](const HttpVisitor& visitor) {
      const std::lock_guard lock(mutex_);
      joins_.push_back(visitor.join);
      peers_.push_back(visitor.peer);
      return false;
    };
  }
  std::function<int()> joinOf(const std::string& from) {
    TestClient visitor(board_->port(), from);
    visitor.send("GET / HTTP/1.1\r\n\r\n");
    EXPECT_TRUE(visitor.rest().starts_with("HTTP/1.1 503 "));
    const std::lock_guard lock(mutex_);
    EXPECT_EQ(peers_.back(), from);
    return joins_.back();
  }

  CountingWorld world_;
  BoardConfig config_ = fewPlaces(8, 2);
  std::unique_ptr<RunningBoard> board_;
  std::mutex mutex_;
  std::vector<std::function<int()>> joins_;
  std::vector<std::string> peers_;
};

TEST_F(JoiningTest, AVisitorsClientsAreThoseOfItsComputer) {
  board_ = std::make_unique<RunningBoard>(world_, config_);
  const auto join = joinOf(kOther);
  TestClient first(TestClient::Connected{join()});
  TestClient second(TestClient::Connected{join()});
  for (TestClient* client : {&first, &second})
    EXPECT_TRUE(client->ask(kHello).starts_with("OK HELLO"));
  TestClient third(TestClient::Connected{join()});
  const std::string refusal = "* ERR limit there are 2 clients from 127.0.0.2 already";
  EXPECT_EQ(third.line(), refusal);
  EXPECT_EQ(TestClient(board_->port(), kOther).ask(kHello), refusal);
  EXPECT_TRUE(TestClient(board_->port()).ask(kHello).starts_with("OK HELLO"));
}

TEST_F(JoiningTest, AWrongTokenIsThatOfTheVisitorsComputer) {
  std::string log;
  config_.tokens = {{"boss", "12345678"}};
  config_.guests = true;
  config_.limits.refusal = 0.01;
  config_.log = [&](const std::string& text) { log += text + "\n"; };
  board_ = std::make_unique<RunningBoard>(world_, config_);
  TestClient thief(TestClient::Connected{joinOf(kOther)()});
  EXPECT_EQ(thief.ask("HELLO ortung/1 name=boss token=87654321"),
            "* ERR token it is missing or wrong");
  board_.reset();
  EXPECT_EQ(log, "a client at 127.0.0.2 that calls itself 'boss' has a wrong token\n");
}

TEST_F(JoiningTest, WhatAVisitorSaysIsTheProtocolWhateverItLooksLike) {
  board_ = std::make_unique<RunningBoard>(world_, config_);
  TestClient client(TestClient::Connected{joinOf(kOther)()});
  EXPECT_TRUE(client.ask("GET / HTTP/1.1").starts_with("ERR unknown there is no command GET"));
}

TEST_F(JoiningTest, ThereIsNoWayToABoardThatIsGone) {
  board_ = std::make_unique<RunningBoard>(world_, config_);
  const auto join = joinOf(kOther);
  TestClient client(TestClient::Connected{join()});
  client.ask(kHello);
  board_.reset();
  EXPECT_EQ(client.line(), "* BYE the server ends");
  EXPECT_EQ(join(), -1);
}

}  // namespace
}  // namespace ortung::test

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <stdexcept>

#include "StandInBox.hpp"
#include "ortung/refbox/RefBoxClient.hpp"

namespace ortung::refbox {
namespace {

using test::StandInBox;

constexpr const char* kUs = "224.16.32.10";
constexpr const char* kThem = "224.16.32.20";

class RefBoxClientTest : public testing::Test {
 protected:
  RefBoxConfig configOf() const {
    RefBoxConfig config;
    config.port = box.port();
    return config;
  }
  void begin(const RefBoxConfig& config) {
    client = std::make_unique<RefBoxClient>(
        config, [this] { return state; }, [this](const std::string& text) { take(text); },
        [this](const std::string& text) { told.push_back(text); });
  }
  void begin() { begin(configOf()); }
  void take(const std::string& order) {
    if (order == refused) throw std::invalid_argument("the order '" + order + "' is refused");
    orders.push_back(order);
  }

  /// Lets both go on until something holds; the client's clock stands still.
  template <class Condition>
  bool until(const Condition& holds) {
    constexpr int kMost = 5000;  // of a millisecond at most
    for (int i = 0; i < kMost && !holds(); ++i) {
      client->poll(now);
      box.look();
    }
    return holds();
  }
  bool connects() {
    return until([this] { return client->isConnected() && box.hasClient(); });
  }
  /// What was said before this command has been read when its order is there.
  bool hears() {
    const std::size_t before = orders.size();
    box.command("STOP");
    return until([&] { return orders.size() > before && orders.back() == "stop"; });
  }
  std::string allTold() const {
    std::string all;
    for (const std::string& line : told) all += line + "\n";
    return all;
  }

  StandInBox box;
  std::unique_ptr<RefBoxClient> client;
  WorldState state{"ants", "attack", {}, {}, {}, 0.05};
  std::vector<std::string> orders;
  std::vector<std::string> told;
  std::string refused;
  double now = 100.0;
};

TEST_F(RefBoxClientTest, HandsOnWhatTheBoxCommands) {
  begin();
  ASSERT_TRUE(connects());
  box.command(" WELCOME", kUs);  // as the box writes it
  box.command("FIRST_HALF");
  box.command("KICKOFF", kThem);
  box.command("START");
  box.command("THROWIN", kUs);
  box.command("GOAL", kUs);
  box.command("SUBGOAL", kUs);
  box.command("GAMEOVER");
  ASSERT_TRUE(hears());
  EXPECT_EQ(client->address(), kUs);
  EXPECT_EQ(orders,
            (std::vector<std::string>{"first-half", "kick-off yellow", "start", "throw-in blue",
                                      "goal blue", "no-goal blue", "end", "stop"}));
  EXPECT_EQ(told.size(), 1U) << allTold();
}

TEST_F(RefBoxClientTest, TellsTheTeamsStateOnceAPeriod) {
  state.robots.push_back({.id = 2, .pose = {1, 2, 3}});
  begin();
  ASSERT_TRUE(connects());
  ASSERT_TRUE(until([&] { return box.messages().size() == 1; }));
  ASSERT_TRUE((box.command("WELCOME", kUs), hears()));
  EXPECT_EQ(box.messages().size(), 1U) << "the client's clock stood still";
  now += 0.11;
  state.intention = "defend";
  ASSERT_TRUE(until([&] { return box.messages().size() == 2; }));
  const auto first = nlohmann::json::parse(box.messages()[0]);
  EXPECT_EQ(first["type"], "worldstate");
  EXPECT_EQ(first["intention"], "attack");
  EXPECT_EQ(first["robots"][0]["pose"], (std::vector<double>{1, 2, 3}));
  EXPECT_EQ(nlohmann::json::parse(box.messages()[1])["intention"], "defend");
}

TEST_F(RefBoxClientTest, MessagesMayComeInPieces) {
  begin();
  ASSERT_TRUE(connects());
  const std::string text = "{\"command\": \"START\", \"targetTeam\": \"\"}";
  for (const char c : text) {
    box.send({&c, 1});
    client->poll(now);
  }
  EXPECT_TRUE(orders.empty());
  box.send({"\0", 1});
  EXPECT_TRUE(until([&] { return orders.size() == 1; }));
}

TEST_F(RefBoxClientTest, NonsenseIsToldOnceAndPassedOver) {
  begin();
  ASSERT_TRUE(connects());
  box.command("WELCOME", kUs);
  const char* const kNonsense[] = {
      "kick!",
      "[1, 2]",
      "{\"command\": 3, \"targetTeam\": \"\"}",
      "{\"targetTeam\": \"\"}",
      "{\"command\": \"START\", \"targetTeam\": 7}",
      "{\"command\": \"DANCE\", \"targetTeam\": \"\"}",
      "{\"command\": \"KICKOFF\", \"targetTeam\": \"\"}",
      "{\"command\": \"IS_ALIVE\", \"targetTeam\": \"\", \"robotID\": 1.5}",
      "{\"command\": \"STA\xff\", \"targetTeam\": \"\"}"};
  for (const char* message : kNonsense) {
    told.clear();
    orders.clear();
    box.say(message);
    ASSERT_TRUE(hears()) << message;
    EXPECT_EQ(orders.size(), 1U) << message;
    told.erase(std::remove(told.begin(), told.end(),
                           "connected to the RefBox 127.0.0.1:" + std::to_string(box.port())),
               told.end());
    EXPECT_EQ(told.size(), 1U) << message << "\n" << allTold();
  }
  EXPECT_TRUE(client->isConnected());
}

TEST_F(RefBoxClientTest, AMessageWithoutEndTakesNoMemory) {
  RefBoxConfig config = configOf();
  config.longestMessage = 1000;
  begin(config);
  ASSERT_TRUE(connects());
  for (int i = 0; i < 50; ++i) {
    box.send(std::string(1000, 'x'));
    client->poll(now);
  }
  box.send({"\0", 1});
  ASSERT_TRUE(hears());
  EXPECT_EQ(told.size(), 2U) << allTold();
  EXPECT_NE(told.back().find("longer than 1000 bytes"), std::string::npos);
}

TEST_F(RefBoxClientTest, ComplaintsHaveAnEnd) {
  begin();
  ASSERT_TRUE(connects());
  for (int i = 0; i < 500; ++i) box.say("nonsense");
  ASSERT_TRUE(hears());
  EXPECT_LT(told.size(), 30U);
  EXPECT_NE(told.back().find("further nonsense"), std::string::npos);
}

TEST_F(RefBoxClientTest, AFloodOfCommandsIsTakenAsSlowlyAsARefereeGivesThem) {
  begin();
  ASSERT_TRUE(connects());
  for (int i = 0; i < 200; ++i) box.command(i % 2 == 0 ? "START" : "STOP");
  ASSERT_TRUE(until([&] { return allTold().find("too fast") != std::string::npos; })) << allTold();
  EXPECT_EQ(orders.size(), 100U);
  for (int i = 0; i < 20; ++i) client->poll(now);
  EXPECT_EQ(orders.size(), 100U) << "its clock stands still";
  now += 5.0;
  ASSERT_TRUE(until([&] { return orders.size() == 110; }));
  now += 1000.0;  // as many as at first
  ASSERT_TRUE(until([&] { return orders.size() == 200; })) << "none is lost";
  EXPECT_EQ(orders.back(), "stop");
  EXPECT_EQ(told.size(), 2U) << allTold();
}

TEST_F(RefBoxClientTest, ABoxThatComesAndGoesIsNotToldForEver) {
  begin();
  for (int i = 0; i < 100; ++i) {
    ASSERT_TRUE(connects()) << i;
    box.hangUp();
    ASSERT_TRUE(until([&] { return !client->isConnected(); })) << i;
    now += 1.0;
  }
  EXPECT_LT(told.size(), 75U) << "60 lines, and one in 10 s";
  EXPECT_GT(told.size(), 60U);
  EXPECT_NE(told.back().find("lines before were not told"), std::string::npos) << told.back();
}

TEST_F(RefBoxClientTest, AnOrderThatTheRefereeRefusesIsTold) {
  refused = "start";
  begin();
  ASSERT_TRUE(connects());
  box.command("START");
  ASSERT_TRUE(hears());
  EXPECT_NE(allTold().find("the order 'start' is refused"), std::string::npos);
}

TEST_F(RefBoxClientTest, ConnectsAgainWhenTheBoxIsBack) {
  begin();
  ASSERT_TRUE(connects());
  box.close();
  box.hangUp();
  ASSERT_TRUE(until([&] { return !client->isConnected(); }));
  const std::size_t before = told.size();
  for (int attempt = 0; attempt < 5; ++attempt) {
    now += 1.1;
    for (int i = 0; i < 50; ++i) {
      client->poll(now);
      ::poll(nullptr, 0, 1);
    }
    EXPECT_FALSE(client->isConnected());
  }
  EXPECT_LE(told.size(), before + 1) << "the same is not told with every attempt: " << allTold();
  box.open();
  now += 1.1;
  ASSERT_TRUE(connects());
  EXPECT_TRUE(hears());
}

TEST_F(RefBoxClientTest, WaitsBetweenAttempts) {
  box.close();
  begin();
  ASSERT_TRUE(until([&] { return told.size() == 1; })) << "it tells that nobody is there";
  box.open();
  for (int i = 0; i < 50; ++i) {
    client->poll(now + 0.9);
    box.look();
  }
  EXPECT_FALSE(box.hasClient());
  now += 1.0;
  EXPECT_TRUE(connects());
}

TEST_F(RefBoxClientTest, ATeamThatTheBoxDoesNotKnowIsTold) {
  begin();
  ASSERT_TRUE(connects());
  box.command("RESET");
  box.command("KICKOFF", kUs);
  ASSERT_TRUE(hears());
  EXPECT_EQ(orders, std::vector<std::string>{"stop"});
  EXPECT_NE(allTold().find("does not know this team's address"), std::string::npos) << allTold();
  EXPECT_NE(allTold().find("KICKOFF came before"), std::string::npos) << allTold();
}

TEST_F(RefBoxClientTest, TheAddressMayBeGiven) {
  RefBoxConfig config = configOf();
  config.address = kThem;
  config.ownTeam = "wasps";
  config.otherTeam = "ants";
  begin(config);
  ASSERT_TRUE(connects());
  box.command("CORNER", kThem);
  box.command("CORNER", kUs);
  ASSERT_TRUE(hears());
  EXPECT_EQ(orders, (std::vector<std::string>{"corner wasps", "corner ants", "stop"}));
}

/// A box that does not read does not make the client's output grow, nor hold it up.
TEST_F(RefBoxClientTest, ABoxThatDoesNotReadGetsLess) {
  state.intention = std::string(100'000, 'i');
  begin();
  ASSERT_TRUE(connects());
  for (int i = 0; i < 2000; ++i) {
    now += 0.2;
    client->poll(now);
  }
  EXPECT_TRUE(client->isConnected());
  box.command("START");
  EXPECT_TRUE(until([&] { return !orders.empty(); }));
  EXPECT_LT(box.messages().size(), 500U);
}

TEST(RefBoxConfig, IsChecked) {
  const auto isRefused = [](auto change) {
    RefBoxConfig config;
    change(config);
    EXPECT_THROW(config.check(), std::invalid_argument);
  };
  EXPECT_NO_THROW(RefBoxConfig{}.check());
  isRefused([](auto& c) { c.host.clear(); });
  isRefused([](auto& c) { c.port = 0; });
  isRefused([](auto& c) { c.otherTeam = "blue"; });
  isRefused([](auto& c) { c.reportPeriod = 0; });
  isRefused([](auto& c) { c.retry = -1; });
  isRefused([](auto& c) { c.connectTimeout = 0; });
  isRefused([](auto& c) { c.longestMessage = 0; });
}

}  // namespace
}  // namespace ortung::refbox

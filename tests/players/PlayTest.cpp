// `ortung play` as its users meet it.
#include <gtest/gtest.h>

#include <csignal>

#include "Await.hpp"
#include "Files.hpp"
#include "Paths.hpp"
#include "Program.hpp"
#include "TestClient.hpp"

namespace ortung::test {
namespace {

const std::string kMaps = ORTUNG_SOURCE_DIR "/maps";
const std::vector<std::string> kPlugins = {"ORTUNG_PLUGIN_PATH=" ORTUNG_PLUGINS_DIR
                                           ":" TEST_EXAMPLES};

std::uint16_t portOf(Program& server) {
  const std::string out = server.waitForOutput("\n");
  const std::size_t place = out.find("port ");
  if (place == std::string::npos) throw std::runtime_error("the server did not start");
  return static_cast<std::uint16_t>(std::stoi(out.substr(place + 5)));
}

Outcome play(const std::string& player, std::uint16_t port,
             const std::vector<std::string>& more = {"--lockstep"}) {
  std::vector<std::string> arguments = {"play", player, "--server",
                                        "127.0.0.1:" + std::to_string(port)};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return ortung(arguments, kPlugins);
}

TEST(Play, EndsWithThePlayerAndItsRobotLeaves) {
  Program server({"sim", kMaps + "/fields/arena.toml", "--listen", "0", "--lockstep"});
  const std::uint16_t port = portOf(server);
  const Outcome ended = play("shy:plays_s=2&name=anna&start=0.5,-1.5,40@blue", port);
  EXPECT_EQ(ended.exitCode, 0) << ended.err;
  EXPECT_EQ(ended.out, "127.0.0.1:" + std::to_string(port) + ": anna played until 2.00 s\n");
  const Outcome timed = play("shy", port, {"--lockstep", "--duration", "1"});
  EXPECT_EQ(timed.exitCode, 0) << timed.err;
  TestClient client(port);
  client.ask("HELLO ortung/1");
  EXPECT_EQ(client.ask("LIST robots"), "OK LIST lines=0");
  server.signal(SIGTERM);
  EXPECT_EQ(server.finish().exitCode, 0);
}

TEST(Play, InRealTimeItPlaysUntilASignal) {
  Program server({"sim", kMaps + "/fields/arena.toml", "--listen", "0"});
  const std::uint16_t port = portOf(server);
  TestClient client(port);
  client.ask("HELLO ortung/1");
  Program player({"play", "shy:name=anna", "--server", "127.0.0.1:" + std::to_string(port)},
                 kPlugins);
  ASSERT_TRUE(comesTrue("there is a robot",
                        [&] { return client.ask("LIST robots") == "OK LIST lines=1"; }));
  EXPECT_EQ(client.line(), "robot=1 name=anna client=2");
  player.signal(SIGTERM);
  EXPECT_EQ(player.finish().exitCode, 0);
  server.signal(SIGTERM);
  EXPECT_EQ(server.finish().exitCode, 0);
}

// A nanosecond is less than any call takes.
TEST(Play, APlayerThatTakesMoreThanItsTimeIsStopped) {
  Program server({"sim", kMaps + "/fields/arena.toml", "--listen", "0", "--lockstep"});
  const std::uint16_t port = portOf(server);
  const auto within = [&](const char* milliseconds) {
    return play("shy", port, {"--lockstep", "--duration", "1", "--player-budget-ms", milliseconds});
  };
  const Outcome stopped = within("0.000001");
  EXPECT_EQ(stopped.exitCode, 1);
  EXPECT_NE(stopped.err.find("the player 'shy' of robot "), std::string::npos) << stopped.err;
  EXPECT_NE(stopped.err.find(" s of processor time, expected at most "), std::string::npos)
      << stopped.err;
  const Outcome unlimited = within("0");
  EXPECT_EQ(unlimited.exitCode, 0) << unlimited.err;
  server.signal(SIGTERM);
  EXPECT_EQ(server.finish().exitCode, 0);
}

TEST(Play, SaysWhatIsWrong) {
  Program server({"sim", kMaps + "/fields/arena.toml", "--listen", "0"});
  const std::uint16_t port = portOf(server);
  struct Case {
    const char* player;
    int exitCode;
    const char* what;
  };
  for (const Case& one :
       {Case{"wander:robot=pioneer.toml", 1, "'wander' needs the world's state, which clients"},
        Case{"shy:near_m=far", 1, "near_m"}, Case{"shy:farther_m=2", 1, "farther_m"},
        Case{"nobody", 1, "nobody"}, Case{"shy:robot=nowhere.toml", 1, "nowhere.toml"},
        Case{"shy", 1, "LOCKSTEP"}}) {
    const Outcome outcome = play(one.player, port);
    EXPECT_EQ(outcome.exitCode, one.exitCode) << one.player;
    EXPECT_NE(outcome.err.find(one.what), std::string::npos) << one.player << ": " << outcome.err;
  }
  const Outcome place = ortung({"play", "shy", "--server", "7777"}, kPlugins);
  EXPECT_EQ(place.exitCode, 2);
  EXPECT_NE(place.err.find("--server is '7777', expected HOST:PORT"), std::string::npos)
      << place.err;
  server.signal(SIGTERM);
  EXPECT_EQ(server.finish().exitCode, 0);
}

}  // namespace
}  // namespace ortung::test

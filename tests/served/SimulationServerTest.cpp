// A simulated world on the message board.
#include <gtest/gtest.h>

#include <fstream>

#include "Files.hpp"
#include "RunningBoard.hpp"
#include "TestClient.hpp"
#include "ortung/served/ServedSimulation.hpp"

namespace ortung::test {
namespace {

TEST(Protocol, TheSessionOfThePageIsReplayedByteForByte) {
  ServedSimulation world(ORTUNG_SOURCE_DIR "/maps/fields/arena.toml", {.noise = false});
  const RunningBoard board(world, lockstepConfig());
  TestClient client(board.port());
  std::ifstream page(ORTUNG_SOURCE_DIR "/docs/protocol.md");
  std::string text;
  while (std::getline(page, text) && text != "```session") {
  }
  int replies = 0;
  while (std::getline(page, text) && text != "```") {
    ASSERT_TRUE(text.starts_with("> ") || text.starts_with("< ")) << text;
    const std::string line = text.substr(2);
    if (text[0] == '>') {
      client.send(line + "\n");
      continue;
    }
    EXPECT_EQ(client.bytes(line.size() + 1), line + "\n");
    ++replies;
  }
  EXPECT_GT(replies, 20);
  EXPECT_EQ(client.line(), "(closed)");  // after BYE
}

TEST(Protocol, ManipulatorsAreSetByNameOrNumber) {
  ServedSimulation world(ORTUNG_SOURCE_DIR "/maps/fields/msl.toml", {.noise = false});
  const RunningBoard board(world, lockstepConfig());
  TestClient client(board.port());
  ASSERT_TRUE(client.join(readBytes(ORTUNG_SOURCE_DIR "/maps/robots/msl_omni.toml"), "striker")
                  .starts_with("OK CREATE"));
  const std::string reply = client.ask("DESCRIBE robot");
  std::string kicker;
  for (int lines = std::stoi(valueOf(reply, "lines")); lines > 0; --lines) {
    const std::string line = client.line();
    if (line.starts_with("manipulator kicker ")) kicker = line.substr(19);
  }
  const std::string first = kicker.substr(0, kicker.find(' '));
  ASSERT_FALSE(first.empty());
  EXPECT_EQ(client.ask("MANIPULATOR kicker " + first), "OK MANIPULATOR");
  EXPECT_EQ(client.ask("MANIPULATOR kicker 1"), "OK MANIPULATOR");
  EXPECT_TRUE(client.ask("MANIPULATOR kicker 99")
                  .starts_with("ERR no-manipulator robot striker: its manipulator kicker has no "
                               "state '99', but " +
                               first + ","));
  EXPECT_TRUE(client.ask("MANIPULATOR arm up")
                  .starts_with("ERR no-manipulator robot striker has no manipulator 'arm', but"));
  EXPECT_TRUE(
      client.ask("MOTION 1").starts_with("ERR number robot striker: a command of 1 numbers"));
}

TEST(Limits, BeamsAndPeriodsCountAsRays) {
  ServedSimulation world(ORTUNG_SOURCE_DIR "/maps/fields/arena.toml", {});
  const RunningBoard board(world, {});
  TestClient client(board.port());
  const std::string scanner = "[[sensor]]\nplugin = \"lrf\"\nbeams = 8000\nfov_deg = 180\n";
  EXPECT_TRUE(client.join(scanner + "period_s = 0.01\n")
                  .starts_with("ERR limit the robot's sensors need 800000 rays a second"));
  client.send("CREATE slow\n" + scanner + "period_s = 0.1\n");
  EXPECT_TRUE(client.ask(".").starts_with("OK CREATE"));
}

TEST(Security, NoFeatureTakesThePlaceOfTheTruePose) {
  ServedSimulation world(ORTUNG_SOURCE_DIR "/maps/fields/arena.toml", {});
  const RunningBoard board(world, {});
  TestClient client(board.port());
  EXPECT_EQ(
      client.join("[[sensor]]\nplugin = \"lrf\"\nmodel = \"reference\"\n"
                  "type = \"groundTruth\"\nfeature = \"pose\"\n"),
      "ERR configuration robot file:2: plugin 'lrf': reference/groundTruth/pose is not a true "
      "pose; no other feature may have the type groundTruth");
}

TEST(Security, PluginsThatAreNotOfRobotsAreRefusedByName) {
  ServedSimulation world(ORTUNG_SOURCE_DIR "/maps/fields/arena.toml", {});
  const RunningBoard board(world, {});
  TestClient client(board.port());
  client.ask("HELLO ortung/1");
  for (const std::string source : {"sim", "tcp"}) {  // offered as sources only
    client.send("CREATE r\n[[sensor]]\nplugin = \"" + source + "\"\n");
    EXPECT_TRUE(client.ask(".").starts_with(
        "ERR configuration robot file:2: plugin is not one of the plugins of this server:"));
  }
}

TEST(SimulationServer, AWandererStopsWanderingWhenItIsToldToMove) {
  ServedSimulation world(ORTUNG_SOURCE_DIR "/maps/fields/arena.toml", {.noise = false});
  const RunningBoard board(world, lockstepConfig());
  TestClient client(board.port());
  client.ask("HELLO ortung/1");
  client.send(
      "CREATE scout drive=wander\n[robot]\nradius_m = 0.2\n[[sensor]]\nplugin = \"odometry\"\n");
  ASSERT_TRUE(client.ask(".").starts_with("OK CREATE"));
  client.ask("LOCKSTEP on");
  const auto pose = [&](int cycles) {
    client.ask("NEXT none/*/* cycles=" + std::to_string(cycles));
    client.ask("READ */groundTruth/*");
    const std::string line = client.line();
    return line.substr(line.find(' '));
  };
  const std::string before = pose(50);
  EXPECT_NE(pose(50), before);
  EXPECT_EQ(client.ask("VELOCITY v_m_s=0 w_rad_s=0"), "OK VELOCITY");
  const std::string stopped = pose(200);
  EXPECT_EQ(pose(200), stopped);
}

}  // namespace
}  // namespace ortung::test

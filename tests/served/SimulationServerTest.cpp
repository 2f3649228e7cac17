// A simulated world on the message board.
#include <gtest/gtest.h>

#include <fstream>
#include <regex>

#include "Files.hpp"
#include "Paths.hpp"
#include "RunningBoard.hpp"
#include "TestClient.hpp"
#include "ortung/served/ServedSimulation.hpp"
#include "ortung/server/RecordedWorld.hpp"

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

const std::string kScout =
    "[robot]\nradius_m = 0.2\n[[sensor]]\nplugin = \"odometry\"\n[[sensor]]\nplugin = \"lrf\"\n"
    "feature = \"FiveBeams\"\nbeams = 5\n";

/// The page's form of a reply: N for numbers, X for a fingerprint.
std::string withoutNumbers(const std::string& line) {
  static const std::regex kFingerprint("fingerprint=[0-9a-f]{16}");
  static const std::regex kNumber("[0-9]+(\\.[0-9]+)?(e[-+]?[0-9]+)?");
  return std::regex_replace(std::regex_replace(line, kFingerprint, "fingerprint=X"), kNumber, "N");
}

/// The lines of a fenced block of docs/protocol.md.
std::vector<std::string> blockOfThePage(const std::string& name) {
  std::ifstream page(ORTUNG_SOURCE_DIR "/docs/protocol.md");
  std::string text;
  while (std::getline(page, text) && text != "```" + name) {
  }
  std::vector<std::string> lines;
  while (std::getline(page, text) && text != "```") lines.push_back(text);
  return lines;
}

TEST(Protocol, TheRecordingOfThePageIsReplayedByteForByte) {
  const TemporaryFolder folder;
  ServedSimulation simulation(ORTUNG_SOURCE_DIR "/maps/fields/arena.toml", {.noise = false});
  Recordings recordings({.folder = folder.path()});
  RecordedWorld world(simulation, recordings, {});
  BoardConfig config = controlledConfig();
  config.commands = {recordCommand(world)};
  const RunningBoard board(world, config);
  TestClient client(board.port());
  client.join(kScout, "anna", "x_m=0.5 y_m=-1.5", "scout");
  client.ask("LOCKSTEP on");
  std::size_t replies = 0;
  for (const std::string& text : blockOfThePage("recording")) {
    const std::string line = text.substr(2);
    if (text[0] == '>') {
      client.send(line + "\n");
      continue;
    }
    EXPECT_EQ(client.line(), line);
    ++replies;
  }
  EXPECT_GT(replies, 8u);
}

TEST(Protocol, RepliesHaveTheFormsOfThePage) {
  ServedSimulation world(ORTUNG_SOURCE_DIR "/maps/fields/arena.toml", {.noise = false});
  const RunningBoard board(world, controlledConfig());
  TestClient client(board.port());
  ASSERT_TRUE(client.join(kScout, "anna", "x_m=0.5 y_m=-1.5", "scout").starts_with("OK CREATE"));
  client.ask("LOCKSTEP on");
  std::size_t requests = 0;
  int left = 0;  // of the lines that belong to a reply
  const auto skip = [&] {
    for (; left > 0; --left) client.line();
  };
  for (const std::string& text : blockOfThePage("replies")) {
    ASSERT_TRUE(text.starts_with("> ") || text.starts_with("< ")) << text;
    const std::string expected = text.substr(2);
    if (text[0] == '>') {
      EXPECT_EQ(left, 0) << "the page shows less than the reply to what is before " << expected;
      skip();
      client.send(expected + "\n");
      ++requests;
    } else if (expected == "...") {
      skip();
    } else {
      const std::string line = client.line();
      EXPECT_EQ(withoutNumbers(line), withoutNumbers(expected)) << line;
      const std::string lines = left == 0 ? valueOf(line, "lines") : "";
      left = lines.empty() ? std::max(0, left - 1) : std::stoi(lines);
    }
  }
  EXPECT_GT(requests, 25u);
  EXPECT_EQ(client.line(), "(closed)");  // after BYE
}

TEST(Protocol, SubscriptionsComeWithAHeader) {
  ServedSimulation world(ORTUNG_SOURCE_DIR "/maps/fields/arena.toml", {.noise = false});
  const RunningBoard board(world, lockstepConfig());
  TestClient client(board.port());
  client.join("[[sensor]]\nplugin = \"odometry\"\nperiod_s = 0.01\n");
  client.ask("LOCKSTEP on");
  EXPECT_EQ(client.ask("NEXT"), "OK NEXT robot=1 now=10000 lines=2");
  client.line();
  client.line();
  client.ask("SUBSCRIBE */odometry/*");
  client.send("NEXT none/*/*\n");
  EXPECT_EQ(client.lineWith("* UPDATE"), "* UPDATE robot=1 now=20000 lines=1");
  client.line();
  client.ask("SUBSCRIBE */odometry/* form=binary");
  client.send("NEXT none/*/*\n");
  const std::string head = client.lineWith("* UPDATE");
  EXPECT_EQ(withoutNumbers(head), "* UPDATE robot=N now=N bytes=N readings=N");
  EXPECT_EQ(valueOf(head, "readings"), "1");
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
                               "state '99'; it has " +
                               first + ","));
  EXPECT_TRUE(
      client.ask("MANIPULATOR arm up")
          .starts_with("ERR no-manipulator robot striker has no manipulator 'arm'; it has"));
  EXPECT_TRUE(
      client.ask("MOTION 1").starts_with("ERR number robot striker: a command of 1 numbers"));
}

TEST(Limits, BeamsAndPeriodsCountAsRays) {
  ServedSimulation world(ORTUNG_SOURCE_DIR "/maps/fields/arena.toml", {});
  const RunningBoard board(world, {});
  TestClient client(board.port());
  const std::string scanner = "[[sensor]]\nplugin = \"lrf\"\nbeams = 8000\nfov_deg = 180\n";
  const std::string quick = scanner + "period_s = 0.01\n";
  EXPECT_TRUE(client.join(quick + "feature = \"a\"\n" + quick + "feature = \"b\"\n")
                  .starts_with("ERR limit the robot's sensors need 1600000 rays a second"));
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

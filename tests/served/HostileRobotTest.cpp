// Robots that clients make up: shapes and numbers of pieces.
#include <gtest/gtest.h>
#include <stdlib.h>

#include <cmath>
#include <ctime>

#include "Files.hpp"
#include "Paths.hpp"
#include "RunningBoard.hpp"
#include "TestClient.hpp"
#include "ortung/base/Angles.hpp"
#include "ortung/core/PluginGuard.hpp"
#include "ortung/robot/NetworkRobot.hpp"
#include "ortung/robot/TomlFile.hpp"
#include "ortung/served/ServedSimulation.hpp"

namespace ortung::test {
namespace {

const std::string kArena = ORTUNG_SOURCE_DIR "/maps/fields/arena.toml";

std::string body(const std::string& table, const std::string& shape, double x, double y,
                 double width, double depth, int angle = 0) {
  return "[[" + table + "]]\nshape = \"" + shape + "\"\ncenter_m = [" + std::to_string(x) + ", " +
         std::to_string(y) + "]\nsize_m = [" + std::to_string(width) + ", " +
         std::to_string(depth) + "]\nangle_deg = " + std::to_string(angle) + "\n";
}

const std::string kSensor = "[[sensor]]\nplugin = \"odometry\"\n";

/// Drives; the server lives on.
void play(TestClient& client) {
  EXPECT_EQ(client.ask("VELOCITY v_m_s=0.5 w_rad_s=1"), "OK VELOCITY");
  ASSERT_TRUE(client.ask("LOCKSTEP on").starts_with("OK LOCKSTEP"));
  EXPECT_TRUE(client.ask("NEXT cycles=300 nothing/*/*").starts_with("OK NEXT"));
}

TEST(HostileRobot, ThinShapesEndNoServer) {
  ServedSimulation world(kArena, {.noise = false});
  const RunningBoard board(world, lockstepConfig());
  for (const std::string& text :
       {body("body", "rectangle", 0.0, 0.0, 0.004, 0.004),
        body("body", "rectangle", 0.0, 0.0, 0.001, 0.3),
        body("body", "ellipse", 0.0, 0.0, 0.007, 0.015),
        body("body", "ellipse", 0.0, 0.0, 0.001, 0.4),
        std::string("[[body]]\nshape = \"triangle\"\ncorners_m = [0, 0, 0.3, 0, 0.1, 0.0011]\n"),
        body("body", "ellipse", 0.0, 0.0, 0.2, 0.2) +
            "[[manipulator]]\nname = \"arm\"\n[[manipulator.state]]\nname = \"thin\"\n" +
            body("manipulator.state.body", "rectangle", 0.2, 0.0, 0.2, 0.001)}) {
    TestClient client(board.port());
    ASSERT_TRUE(client.join(kSensor + text, "thin").starts_with("OK CREATE")) << text;
    play(client);
    EXPECT_EQ(client.ask("BYE"), "OK BYE");
  }
}

TEST(HostileRobot, TooThinOrTooManyIsRefusedByName) {
  ServedSimulation world(kArena, {.noise = false});
  const RunningBoard board(world, lockstepConfig());
  int tries = 0;
  TestClient status(board.port());
  ASSERT_TRUE(status.ask("HELLO ortung/1 name=watcher role=viewer").starts_with("OK HELLO"));
  const auto refusal = [&](const std::string& text) {
    TestClient client(board.port());
    return client.join(kSensor + text, "bad" + std::to_string(++tries));
  };
  EXPECT_NE(refusal(body("body", "rectangle", 0.0, 0.0, 0.0004, 0.3)).find("size_m"),
            std::string::npos);
  std::string many;
  for (int i = 0; i < 33; ++i) many += body("body", "rectangle", 0.0, 0.0, 0.3, 0.3, i);
  const std::string reply = refusal(many);
  EXPECT_NE(reply.find("at most 32 pieces"), std::string::npos) << reply;
  std::string round;
  for (int i = 0; i < 5; ++i) round += body("body", "ellipse", 0.0, 0.0, 0.3, 0.2, i);
  EXPECT_NE(refusal(round).find("at most 32 pieces"), std::string::npos);
  // Pieces of all states count together.
  std::string arms = body("body", "ellipse", 0.0, 0.0, 0.2, 0.2);
  for (int i = 0; i < 16; ++i)
    arms += "[[manipulator]]\nname = \"m" + std::to_string(i) +
            "\"\n[[manipulator.state]]\nname = " + "\"s\"\n" +
            body("manipulator.state.body", "rectangle", 0.0, 0.0, 0.3, 0.3, i) +
            body("manipulator.state.body", "rectangle", 0.0, 0.0, 0.3, 0.3, i + 20);
  EXPECT_NE(refusal(arms).find("at most 32 pieces"), std::string::npos);
  EXPECT_TRUE(status.ask("STATUS").starts_with("OK STATUS"));
}

TEST(HostileRobot, ManyPiecesOfAllRobotsAreALimit) {
  ServedSimulation world(ORTUNG_SOURCE_DIR "/maps/fields/msl.toml", {.noise = false});
  std::string star;
  for (int i = 0; i < 32; ++i) star += body("body", "rectangle", 0.0, 0.0, 0.4, 0.39, 3 * i);
  const RobotConfig config = readNetworkRobot(kSensor + star, "the client's", world.plugins());
  const auto codeOf = [&](RobotId robot, const std::string& name, const Pose2& start) {
    RobotWish wish;
    wish.config = config;
    wish.config.name = name;
    wish.start = start;
    try {
      world.addRobot(robot, std::move(wish));
    } catch (const ServeError& error) {
      return error.code();
    }
    return std::string();
  };
  const auto place = [](RobotId robot) {
    return Pose2{1.0 + 0.7 * (robot % 8), 0.7 * (robot / 8) - 3.0, 0.0};
  };
  for (RobotId robot = 1; robot <= 63; ++robot)
    ASSERT_EQ(codeOf(robot, "r" + std::to_string(robot), place(robot)), "") << robot;
  EXPECT_EQ(codeOf(64, "r64", place(1)), "no-room");
  EXPECT_EQ(codeOf(64, "r64", place(64)), "");
  EXPECT_EQ(codeOf(65, "r65", place(65)), "limit");
}

TEST(HostileRobot, MayHaveTheNameThatAnotherOneWouldGet) {
  ServedSimulation world(kArena, {.noise = false});
  RobotWish wish;
  wish.config = readNetworkRobot(kSensor, "the client's", world.plugins());
  RobotId robot = 0;
  for (const char* name : {"a", "a-3", "a"}) {  // the third is called a-3 by the simulation
    wish.config.name = name;
    EXPECT_NO_THROW(world.addRobot(++robot, wish)) << robot;
  }
}

TEST(HostileRobot, WhosePluginsFailWhenTheyAreAskedIsNotLeftOnTheField) {
  ::setenv("ORTUNG_PLUGIN_PATH", TEST_PLUGINS, 1);
  ServedSimulation world(kArena, {.noise = false});
  ::unsetenv("ORTUNG_PLUGIN_PATH");
  const auto add = [&](RobotId robot, const std::string& text, bool wanders) {
    RobotWish wish;
    wish.config = readRobot(parseToml(text, "robot.toml"));
    wish.start = Pose2{1.0, 0.5, 0.0};
    wish.wanders = wanders;
    world.addRobot(robot, std::move(wish));
  };
  const std::string bad = "plugin = \"misbehaving\"\nwhere = ";
  EXPECT_THROW(add(1, "[[sensor]]\n" + bad + "\"rays\"\n", false), PluginFailure);
  EXPECT_THROW(add(2, "[drive]\n" + bad + "\"limits\"\n" + kSensor, true), PluginFailure);
  EXPECT_NO_THROW(add(3, kSensor, false)) << "somebody stands there";
}

TEST(HostileRobot, ManyPiecesThatPushEachOtherDoNotStopTheWorld) {
  // Ten robots of as many pieces as a client's may have, all on top of each other, meet.
  ServedSimulation world(ORTUNG_SOURCE_DIR "/maps/fields/msl.toml", {.noise = false});
  std::string star;
  for (int i = 0; i < 32; ++i) star += body("body", "rectangle", 0.0, 0.0, 0.4, 0.39, 3 * i);
  for (RobotId robot = 1; robot <= 10; ++robot) {
    const double angle = 0.6283 * robot;
    RobotWish wish;
    wish.config = readNetworkRobot(kSensor + star, "the client's", world.plugins());
    wish.start = Pose2{1.1 * std::cos(angle), 1.1 * std::sin(angle), wrapAngle(angle + 3.14159)};
    world.addRobot(robot, std::move(wish));
    world.commands(robot).setTranslationalVelocity(0.8);
  }
  const std::clock_t before = std::clock();
  constexpr int kCycles = 200;
  for (int i = 0; i < kCycles; ++i) world.step();
  const double took = static_cast<double>(std::clock() - before) / CLOCKS_PER_SEC / kCycles;
  RecordProperty("cycle_ms", std::to_string(1000.0 * took));
  EXPECT_LT(took, 0.03) << "seconds a cycle";
}

}  // namespace
}  // namespace ortung::test

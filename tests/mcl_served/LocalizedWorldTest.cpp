// A simulation whose robots are localized for clients of its message board.
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>

#include "Await.hpp"
#include "LocalizedArena.hpp"
#include "RunningBoard.hpp"
#include "TestClient.hpp"
#include "ortung/core/ReadingLine.hpp"
#include "ortung/formats/PoseFixData.hpp"
#include "ortung/mcl_served/LocalizationCommands.hpp"
#include "ortung/served/PlayerCommands.hpp"

namespace ortung::test {
namespace {

/// The arena on a board, with a client that makes it go on.
struct ServedArena {
  explicit ServedArena(std::vector<std::string> names = {})
      : world(simulation, [&] {
          LocalizedWorld::Config config = arena.config();
          config.names = std::move(names);
          config.robotFile = [this](RobotId robot) -> std::filesystem::path {
            return simulation.simRobot(robot).config().about.where();
          };
          return config;
        }()) {
    client.ask("HELLO ortung/1 name=view role=operator");
    client.ask("LOCKSTEP on");
  }
  BoardConfig config() {
    BoardConfig config = controlledConfig();
    config.commands = localizationCommands(world);
    for (BoardCommand& command : playerCommands(simulation)) config.commands.push_back(command);
    return config;
  }
  /// Lets the world go on until LOCALIZE says so.
  std::string await(const std::string& state, const std::string& robot = "1") {
    std::string reply;
    EXPECT_TRUE(comesTrue("robot " + robot + " is " + state, [&] {
      client.ask("NEXT cycles=5");
      reply = client.ask("LOCALIZE robot=" + robot);
      return valueOf(reply, "state") == state;
    })) << reply;
    return reply;
  }
  std::vector<std::string> lines(const std::string& request) {
    std::vector<std::string> lines;
    const std::string count = valueOf(client.ask(request), "lines");
    for (int left = count.empty() ? 0 : std::stoi(count); left > 0; --left)
      lines.push_back(client.line());
    return lines;
  }
  /// Lets the world go on until the robot believes to be within @p metres of a place.
  void awaitBelief(const Pose2& place, double metres) {
    EXPECT_TRUE(comesTrue("the estimate is there", [&] {
      if (distance(believed(), place) <= metres) return true;
      client.ask("NEXT none/*/* cycles=1");
      return false;
    }));
  }
  /// Where the robot is believed to be by the newest estimate.
  Pose2 believed() {
    const std::vector<std::string> read = lines("READ mcl/LOCALIZATION/pose robot=1");
    if (read.size() != 1) return {1e9, 1e9, 0.0};
    const auto message = parseLine(read.front());
    PoseFixData data(message->id, {});
    data.setData(message->stamp, message->words);
    return data.reading().front().pose;
  }

  LocalizedArena arena;
  ServedSimulation simulation{arena.scene(), {.noise = false}};
  LocalizedWorld world;
  RunningBoard board{world, config()};
  TestClient client{board.port()};
};

TEST(LocalizedWorld, RobotsAreLocalizedWhenAnOperatorSaysSo) {
  ServedArena served;
  EXPECT_EQ(served.client.ask("LOCALIZE robot=1"), "OK LOCALIZE robot=1 state=off progress=0");
  EXPECT_TRUE(
      served.client.ask("HEATMAP robot=1").starts_with("ERR state robot 1 is not localized"));
  std::size_t described = 0;
  for (const std::string& line : served.lines("DESCRIBE robot robot=1"))
    if (line.starts_with("mcl/LOCALIZATION/")) ++described;
  EXPECT_EQ(described, 8U);
  EXPECT_EQ(valueOf(served.client.ask("LOCALIZE robot=1 on"), "state"), "learning");
  served.await("running");
  EXPECT_TRUE(served.client.ask("READ mcl/LOCALIZATION/samples robot=1 form=binary")
                  .starts_with("OK READ robot=1"));
  // The estimate is at the place that it is told until readings correct it; the world stands.
  const Pose2 truth = served.simulation.simRobot(1).state().pose;
  const Pose2 told{truth.x > 0.0 ? -2.4 : 2.4, truth.y > 0.0 ? -1.4 : 1.4, 0.0};
  ASSERT_GT(distance(served.believed(), told), 1.0);
  const std::string place = "x_m=" + std::to_string(told.x) + " y_m=" + std::to_string(told.y);
  EXPECT_TRUE(served.client.ask("LOCALIZE robot=1 " + place + " sigma_m=0.05")
                  .starts_with("OK LOCALIZE robot=1"));
  EXPECT_TRUE(
      comesTrue("the estimate is there", [&] { return distance(served.believed(), told) < 0.5; }));
  EXPECT_TRUE(served.client.ask("LOCALIZE robot=1 x_m=50 y_m=0")
                  .starts_with("ERR argument the pose (50.00, 0.00) m is off the map"));
  EXPECT_EQ(valueOf(served.client.ask("LOCALIZE robot=1 off"), "state"), "off");
}

TEST(LocalizedWorld, SamplesComeForWhoAsksForThem) {
  ServedArena served({"scout"});
  served.await("running");
  EXPECT_TRUE(served.lines("READ */LOCALIZATION/samples robot=1").empty()) << "nobody has asked";
  std::vector<std::string> read;
  ASSERT_TRUE(comesTrue("there are samples", [&] {
    served.client.ask("NEXT none/*/* cycles=5");
    read = served.lines("READ mcl/LOCALIZATION/samples robot=1");
    return !read.empty();
  }));
  const auto reading = parseLine(read.front());
  ASSERT_TRUE(reading);
  EXPECT_GT(reading->words.size(), 0U);
  EXPECT_EQ(reading->words.size() % 4, 0U);
}

TEST(LocalizedWorld, AResetBeginsAnewAndPlayersComeAndGo) {
  ServedArena served({"all"});
  served.await("running");
  EXPECT_TRUE(served.client.ask("RESET").starts_with("OK RESET"));
  EXPECT_TRUE(served.lines("READ mcl/LOCALIZATION/* robot=1").empty());
  served.await("running");
  served.client.ask("NEXT cycles=5");
  const Pose2 truth = served.simulation.simRobot(1).state().pose;
  served.awaitBelief(truth, 1.0);
  EXPECT_EQ(served.client.ask("PLAY wander robot=pioneer.toml name=bert"), "OK PLAY robot=bert");
  EXPECT_NE(valueOf(served.client.ask("LOCALIZE robot=2"), "state"), "off") << "one of all";
  EXPECT_EQ(served.client.ask("STOP bert"), "OK STOP");
  served.client.ask("NEXT none/*/* cycles=1");
  EXPECT_TRUE(served.client.ask("LOCALIZE robot=2").starts_with("ERR no-robot"));
  EXPECT_TRUE(served.client.ask("HEATMAP robot=2").starts_with("ERR state"));
}

TEST(LocalizedWorld, TellsWhatFiltersFinishWhileTheWorldStands) {
  ServedArena served({"scout"});
  TestClient& client = served.client;
  served.await("running");
  const auto stampOf = [&](const std::string& query) {
    const std::vector<std::string> read = served.lines("READ " + query + " robot=1");
    return read.size() == 1 ? parseLine(read.front())->stamp : -1;
  };
  // The newest scan was taken before the world stood; its estimate was not there yet. Scans of a
  // robot that did not move are not weighed: then the world goes on a little.
  int looks = 0;
  Timestamp scan = 0;
  EXPECT_TRUE(comesTrue("there is an estimate of the newest scan", [&] {
    if (looks++ % 500 == 0) {
      client.ask("NEXT cycles=40 none/*/*");
      scan = stampOf("*/LRF/*");
      return false;
    }
    return stampOf("mcl/LOCALIZATION/pose") >= scan;
  }));
}

TEST(LocalizedWorld, NamesThatNobodyHasAreRefused) {
  LocalizedArena arena;
  ServedSimulation simulation(arena.scene(), {.noise = false});
  LocalizedWorld::Config config = arena.config();
  config.names = {"nobody"};
  EXPECT_EQ(messageOf<std::invalid_argument>([&] { LocalizedWorld(simulation, config); }),
            "there is no robot 'nobody'");
  config.names = {"scout"};
  config.robotFile = [](RobotId) { return ""; };
  EXPECT_EQ(messageOf<std::invalid_argument>([&] { LocalizedWorld(simulation, config); }),
            "the robot 'scout' has no features to localize by");
}

}  // namespace
}  // namespace ortung::test

// Players of a served world: clients start, list and stop them, and see their robots come and go.
#include <gtest/gtest.h>

#include <filesystem>
#include <set>
#include <sstream>

#include "Files.hpp"
#include "Paths.hpp"
#include "ProtocolPage.hpp"
#include "RunningBoard.hpp"
#include "TestClient.hpp"
#include "ortung/served/PlayerCommands.hpp"
#include "ortung/served/ServedSimulation.hpp"
#include "ortung/server/ProcessorTime.hpp"

namespace ortung::test {
namespace {

const std::string kField = ORTUNG_SOURCE_DIR "/maps/fields/f2000.toml";
const std::string kRobot = ORTUNG_SOURCE_DIR "/maps/robots/pioneer.toml";

BoardConfig withPlayers(ServedSimulation& world) {
  BoardConfig config = controlledConfig();
  config.commands = playerCommands(world);
  return config;
}

TEST(ServedPlayers, HaveTheCommandsOfThePage) {
  ServedSimulation world(kField, {.noise = false});
  expectDocumented("Players", playerCommands(world));
}

TEST(ServedPlayers, AreStartedListedAndStopped) {
  ServedSimulation world(kField, {.noise = false});
  const RunningBoard board(world, withPlayers(world));
  TestClient client(board.port());
  ASSERT_EQ(client.join(readBytes(kRobot), "guest").substr(0, 17), "OK CREATE robot=1");
  EXPECT_EQ(client.ask("PLAYERS"), "OK PLAYERS");
  EXPECT_EQ(client.ask("PLAY wander robot=pioneer.toml speed_m_s=0.5 team=blue start=2,1,90"),
            "OK PLAY robot=pioneer");
  EXPECT_EQ(client.ask("PLAY wander robot=pioneer.toml name=bert"), "OK PLAY robot=bert");
  EXPECT_EQ(client.ask("PLAYERS"), "OK PLAYERS lines=2");
  EXPECT_TRUE(client.line().starts_with("robot=pioneer player=wander team=blue since="));
  EXPECT_TRUE(client.line().starts_with("robot=bert player=wander since="));
  EXPECT_EQ(client.ask("LIST robots"), "OK LIST lines=3");
  EXPECT_EQ(client.line(), "robot=1 name=guest client=1");
  EXPECT_EQ(client.line(), "robot=2 name=pioneer client=0 team=blue player=wander");
  EXPECT_EQ(client.line(), "robot=3 name=bert client=0 player=wander");
  // Robots of clients have numbers of their own.
  EXPECT_EQ(client.ask("CREATE late\n" + readBytes(kRobot) + "\n.").substr(0, 17),
            "OK CREATE robot=4");
  EXPECT_EQ(client.ask("VELOCITY v_m_s=0 robot=2"), "OK VELOCITY");
  EXPECT_EQ(client.ask("STOP bert"), "OK STOP");
  EXPECT_EQ(client.ask("STOP bert"),
            "ERR no-player no player plays robot 'bert'; PLAYERS lists them");
  EXPECT_EQ(client.ask("LIST robots"), "OK LIST lines=3");
  for (int i = 0; i < 3; ++i) client.line();
  EXPECT_TRUE(client.ask("READ robot=3").starts_with("ERR no-robot"));
  EXPECT_TRUE(client.ask("RESET").starts_with("OK RESET"));
  EXPECT_EQ(client.ask("PLAYERS"), "OK PLAYERS") << "the reset starts over";
  EXPECT_EQ(client.ask("LIST robots"), "OK LIST lines=2") << "those of clients";
  EXPECT_EQ(client.line(), "robot=1 name=guest client=1");
  EXPECT_EQ(client.line(), "robot=4 name=late client=1");
}

TEST(ServedPlayers, OfASceneComeBackAtAResetWhoeverHadTheirNamesMeanwhile) {
  ServedSimulation world(ORTUNG_SOURCE_DIR "/maps/scenes/f2000_match.toml", {.noise = false});
  const RunningBoard board(world, withPlayers(world));
  TestClient client(board.port());
  ASSERT_TRUE(client.ask("HELLO ortung/1 role=operator").starts_with("OK"));
  client.ask("LOCKSTEP on");
  EXPECT_EQ(client.ask("STOP blue2"), "OK STOP");
  EXPECT_EQ(client.ask("PLAY wander robot=pioneer.toml name=blue2"), "OK PLAY robot=blue2");
  EXPECT_TRUE(client.ask("RESET").starts_with("OK RESET"));
  for (int cycle = 0; cycle < 3; ++cycle) {
    EXPECT_TRUE(client.ask("NEXT none/none/none").starts_with("OK NEXT"));
    EXPECT_EQ(client.ask("LIST robots"), "OK LIST lines=8");
    std::string all;
    for (int i = 0; i < 8; ++i) all += client.line() + "\n";
    EXPECT_NE(all.find(" name=blue2 client=0"), all.npos) << all;
  }
}

TEST(ServedPlayers, GetTheirRobotsBackThatClientsHaveTaken) {
  Scene scene;
  scene.world = kField;
  SceneRobot robot;
  robot.file = kRobot;
  robot.name = "anna";
  robot.wanders = true;
  scene.robots.push_back(robot);
  ServedSimulation world(scene, {.noise = false});
  const RunningBoard board(world, withPlayers(world));
  TestClient client(board.port());
  ASSERT_TRUE(client.ask("HELLO ortung/1 role=operator").starts_with("OK"));
  client.ask("PAUSE");
  const auto listed = [&] {
    client.ask("LIST robots");
    return client.line();
  };
  EXPECT_EQ(listed(), "robot=1 name=anna client=0 player=wander");
  EXPECT_TRUE(client.ask("RETURN robot=1").starts_with("ERR no-player robot 1 was not taken"));
  for (const char* command : {"VELOCITY v_m_s=0 robot=1", "MOTION 0 0 robot=1"}) {
    ASSERT_TRUE(client.ask(command).starts_with("OK"));
    ASSERT_EQ(client.ask("STEP cycles=2"), "OK STEP");
    EXPECT_EQ(listed(), "robot=1 name=anna client=0 taken_from=wander") << command;
    EXPECT_EQ(client.ask("PLAYERS"), "OK PLAYERS");
    EXPECT_EQ(client.ask("RETURN robot=1"), "OK RETURN robot=1");
    EXPECT_EQ(listed(), "robot=1 name=anna client=0 player=wander");
    ASSERT_EQ(client.ask("STEP cycles=100"), "OK STEP");
    EXPECT_EQ(listed(), "robot=1 name=anna client=0 player=wander") << "it stays";
  }
  for (const char* request : {"RETURN", "RETURN robot=9", "RETURN robot=x", "RETURN robot=1 y=1"})
    EXPECT_TRUE(client.ask(request).starts_with("ERR ")) << request;
  // At a reset it is its player's from the beginning.
  client.ask("VELOCITY v_m_s=0 robot=1");
  client.ask("STEP");
  EXPECT_TRUE(client.ask("RESET").starts_with("OK"));
  EXPECT_EQ(listed(), "robot=1 name=anna client=0 player=wander");
}

TEST(ServedPlayers, ComeOnlyWhileThereIsRoomForTheirCosts) {
  ServedSimulation world(kField, {.noise = false});
  BoardConfig config = controlledConfig();
  config.commands = playerCommands(world, {.robots = 2});
  for (BoardCommand& command : playerCommands(world, {.load = 0.0})) {
    if (command.name != "PLAY") continue;
    command.name = "PLAY_IDLE";
    config.commands.push_back(command);
  }
  const RunningBoard board(world, config);
  TestClient client(board.port());
  client.ask("HELLO ortung/1 role=operator");
  EXPECT_EQ(client.ask("PLAY_IDLE wander robot=pioneer.toml"), "OK PLAY_IDLE robot=pioneer")
      << "nothing was computed yet";
  client.ask("LOCKSTEP on");
  client.ask("NEXT");
  EXPECT_TRUE(
      client.ask("PLAY_IDLE wander robot=pioneer.toml").starts_with("ERR limit a cycle takes "));
  EXPECT_EQ(client.ask("PLAY wander robot=pioneer.toml"), "OK PLAY robot=pioneer-2");
  EXPECT_EQ(client.ask("PLAY wander robot=pioneer.toml"),
            "ERR limit there are 2 robots on the field, at most 2 are permitted with players that "
            "clients start");
  EXPECT_EQ(client.ask("STOP pioneer"), "OK STOP");
  EXPECT_EQ(client.ask("PLAY wander robot=pioneer.toml"), "OK PLAY robot=pioneer");
}

TEST(ServedPlayers, CostsOfACycleAreAMeanOfTheNewestOnes) {
  ServedSimulation world(kField, {.noise = false});
  PlayerWish wish;
  wish.plugin = "wander";
  wish.robot = kRobot;
  world.startPlayer(wish);
  EXPECT_EQ(world.load(), 0.0) << "before the first";
  const double cycle = 0.01;  // [s]
  double least = 0.0, most = 0.0;
  for (int i = 0; i < 20; ++i) {
    const double before = processorTime();
    world.step();
    const double atMost = (processorTime() - before) / cycle;  // with all that is around it
    const double last = world.load();
    ASSERT_GT(last, least) << "nothing costs nothing";
    most += 0.1 * (atMost - most);
    EXPECT_LE(last, most) << "cycle " << i;
    least = 0.9 * last;  // if the next one cost nothing
  }
}

TEST(ServedPlayers, ThatCantBeSayWhy) {
  ServedSimulation world(kField, {.noise = false});
  const RunningBoard board(world, withPlayers(world));
  TestClient client(board.port());
  client.ask("HELLO ortung/1 name=anna role=operator");
  EXPECT_TRUE(client.ask("PLAY").starts_with("ERR argument PLAY names one plugin"));
  EXPECT_TRUE(client.ask("PLAY nobody").starts_with("ERR configuration there is no plugin"));
  EXPECT_TRUE(client.ask("PLAY wander").starts_with("ERR argument the player 'wander' names no"));
  EXPECT_TRUE(client.ask("PLAY wander robot=/etc/passwd").starts_with("ERR argument robot is"));
  EXPECT_TRUE(client.ask("PLAY wander robot=../robots/pioneer.toml").starts_with("ERR argument"));
  EXPECT_TRUE(client.ask("PLAY wander robot=pioneer.toml tables=pioneer.tables")
                  .starts_with("ERR argument tables is"));
  EXPECT_EQ(client.ask("PLAY learner robot=pioneer.toml out=tables.ortung"),
            "ERR argument out is a file, which clients can't name");
  EXPECT_TRUE(
      client.ask("PLAY wander robot=pioneer.toml speed=2").starts_with("ERR configuration"));
  EXPECT_TRUE(
      client.ask("PLAY wander robot=pioneer.toml speed_m_s=fast").starts_with("ERR configuration"));
  EXPECT_TRUE(client.ask("PLAY wander robot=pioneer.toml team=a@b").starts_with("ERR"));
  EXPECT_EQ(client.ask("PLAY wander robot=pioneer.toml robot=nao.toml"),
            "ERR syntax PLAY has robot= twice, expected it once");
  EXPECT_TRUE(client.ask("PLAY wander robot=pioneer.toml name=").starts_with("ERR configuration"));
  EXPECT_TRUE(client.ask("PLAY wander robot=").starts_with("ERR configuration"));
  EXPECT_TRUE(client.ask("PLAY wander robot=pioneer.toml start=90,0,0").starts_with("ERR no-room"));
  EXPECT_TRUE(client.ask("PLAY wander robot=pioneer.toml stage=no").starts_with("ERR argument"));
  EXPECT_EQ(client.ask("LIST robots"), "OK LIST lines=0");
  client.ask("CREATE guest\n" + readBytes(kRobot) + "\n.");
  EXPECT_EQ(client.ask("LIST robots"), "OK LIST lines=1") << "and nobody stands about";
  client.line();
  TestClient other(board.port());
  other.ask("HELLO ortung/1 name=bert role=player");
  EXPECT_TRUE(other.ask("PLAY wander robot=pioneer.toml").starts_with("ERR role"));
}

TEST(ServedPlayers, SayWhatTheyCanDo) {
  ServedSimulation world(kField, {.noise = false});
  const RunningBoard board(world, withPlayers(world));
  TestClient client(board.port());
  client.ask("HELLO ortung/1 name=anna");
  const std::string reply = client.ask("DESCRIBE players");
  std::set<std::string> lines;
  for (int left = std::stoi(valueOf(reply, "lines")); left > 0; --left) lines.insert(client.line());
  EXPECT_TRUE(lines.contains("player goalkeeper keeps a goal by one of six policies"));
  EXPECT_TRUE(
      lines.contains("option goalkeeper speed_m_s unit=m/s how fast it drives at most; "
                     "default: 1.5"));
  EXPECT_TRUE(lines.contains("option learner out unit=file the table file; must be given"));
  EXPECT_EQ(client.ask("DESCRIBE player"),
            "ERR syntax DESCRIBE knows world, field, robot, robots and players");
}

TEST(ServedPlayers, PlayOnShippedRobotsByTheirNames) {
  ServedSimulation world(kField, {.noise = false});
  const RunningBoard board(world, withPlayers(world));
  TestClient client(board.port());
  client.ask("HELLO ortung/1 name=anna");
  std::set<std::string> names;
  for (int left = std::stoi(valueOf(client.ask("DESCRIBE robots"), "lines")); left > 0; --left) {
    std::istringstream line(client.line());
    std::string kind;
    std::string name;
    line >> kind >> name;
    EXPECT_EQ(kind, "robot");
    names.insert(name);
  }
  std::set<std::string> files;
  for (const auto& file : std::filesystem::directory_iterator(ORTUNG_SOURCE_DIR "/maps/robots"))
    files.insert(file.path().stem().string());
  EXPECT_EQ(names, files);
  EXPECT_EQ(client.ask("PLAY wander robot=pioneer name=one"), "OK PLAY robot=one");
  EXPECT_EQ(client.ask("PLAY wander robot=pioneer.toml name=two"), "OK PLAY robot=two");
  EXPECT_TRUE(client.ask("PLAY wander robot=nothing").starts_with("ERR configuration"));
  EXPECT_TRUE(client.ask("PLAY wander robot=../robots/pioneer").starts_with("ERR argument"));
}

TEST(ServedPlayers, AReferee) {
  Scene scene = Scene::open(kField);
  scene.referee = parseReferee("soccer:league=f2000");
  ServedSimulation world(scene, {.noise = false});
  const RunningBoard board(world, withPlayers(world));
  TestClient client(board.port());
  client.join(readBytes(kRobot), "guest");
  client.ask("LOCKSTEP on");
  client.ask("PLAY wander robot=pioneer.toml team=blue start=-3,2,0");
  EXPECT_TRUE(client.ask("NEXT none/none/none").starts_with("OK NEXT"));
  const std::string game = client.ask("GAME");
  EXPECT_TRUE(game.starts_with("OK GAME phase=")) << game;
  EXPECT_NE(game.find(" half=1 "), std::string::npos) << game;
  EXPECT_NE(game.find(" blue=0 yellow=0 left=blue"), std::string::npos) << game;
  EXPECT_TRUE(client.ask("REFEREE fly away").starts_with("ERR argument"));
  EXPECT_EQ(client.ask("REFEREE stop"), "OK REFEREE");
  EXPECT_TRUE(client.ask("NEXT none/none/none").starts_with("OK NEXT"));
  EXPECT_TRUE(client.ask("GAME").starts_with("OK GAME phase=stopped"));
  // Who comes later asks what has happened.
  TestClient later(board.port());
  later.ask("HELLO ortung/1 name=bert");
  const std::string events = later.ask("EVENTS");
  EXPECT_TRUE(events.starts_with("OK EVENTS next=")) << events;
  const int lines = std::stoi(valueOf(events, "lines"));
  EXPECT_EQ(std::to_string(lines), valueOf(events, "next"));
  ASSERT_GE(lines, 1);
  for (int i = 0; i < lines; ++i) EXPECT_TRUE(later.line().starts_with(std::to_string(i) + " "));
  EXPECT_EQ(later.ask("EVENTS since=" + std::to_string(lines)),
            "OK EVENTS next=" + std::to_string(lines));
  EXPECT_TRUE(later.ask("EVENTS since=x").starts_with("ERR argument"));
}

TEST(ServedPlayers, WithoutARefereeOrdersAreRefused) {
  ServedSimulation world(kField, {.noise = false});
  const RunningBoard board(world, withPlayers(world));
  TestClient client(board.port());
  client.ask("HELLO ortung/1 name=anna role=operator");
  EXPECT_EQ(client.ask("REFEREE stop"), "ERR no-referee nobody referees here");
  EXPECT_TRUE(client.ask("GAME").starts_with("OK GAME phase=free"));
}

}  // namespace
}  // namespace ortung::test

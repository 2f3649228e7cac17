// What robots of one team tell each other, in the simulator, as clients, and across that border.
#include <gtest/gtest.h>

#include <cstdlib>

#include "Paths.hpp"
#include "RunningBoard.hpp"
#include "TestClient.hpp"
#include "ortung/core/PluginFactory.hpp"
#include "ortung/remote/RemotePlay.hpp"
#include "ortung/served/ServedSimulation.hpp"

namespace ortung::test {
namespace {

const std::string kWorld = ORTUNG_SOURCE_DIR "/maps/fields/f2000.toml";
const std::string kRobot = ORTUNG_SOURCE_DIR "/maps/robots/pioneer.toml";
const std::string kParrot = "parrot:robot=" + kRobot + "&name=polly&start=-1,1,0@blue";
const std::string kSensors = "[[sensor]]\nplugin = \"odometry\"\n";

/// The factories of worlds find the players of the tests.
void findTestPlayers() { ::setenv("ORTUNG_PLUGIN_PATH", ORTUNG_PLUGINS_DIR ":" TEST_EXAMPLES, 1); }

/// A client with a robot, in lockstep.
struct Mate {
  TestClient client;
  Mate(std::uint16_t port, const std::string& name, const std::string& where) : client(port) {
    EXPECT_TRUE(client.join(kSensors, name, where, name).starts_with("OK CREATE")) << name;
    EXPECT_EQ(client.ask("LOCKSTEP on"), "OK LOCKSTEP on");
  }
  std::vector<std::string> hear() {
    const std::string reply = client.ask("HEAR");
    EXPECT_TRUE(reply.starts_with("OK HEAR robot=")) << reply;
    std::vector<std::string> lines;
    for (int left = std::stoi(valueOf(reply, "lines")); left > 0; --left)
      lines.push_back(client.line());
    return lines;
  }
};

/// One cycle for all.
void goOn(const std::vector<Mate*>& mates) {
  for (Mate* mate : mates) mate->client.send("NEXT none/*/*\n");
  for (Mate* mate : mates) EXPECT_TRUE(mate->client.line().starts_with("OK NEXT"));
}

using Lines = std::vector<std::string>;

TEST(TeamTalk, IsHeardByTheTeamAloneAcrossTheBorder) {
  findTestPlayers();
  ServedSimulation world(kWorld, {.noise = false});
  world.startPlayer(parsePlayer(kParrot));
  const RunningBoard board(world, controlledConfig());
  Mate anna(board.port(), "anna", "x_m=0.5 y_m=-1.5 team=blue");
  Mate bert(board.port(), "bert", "x_m=1.5 y_m=-1.5 team=red");
  Mate carl(board.port(), "carl", "x_m=0.5 y_m=1.5 team=blue");
  Mate dora(board.port(), "dora", "x_m=1.5 y_m=1.5");
  const std::vector<Mate*> all = {&anna, &bert, &carl, &dora};
  EXPECT_EQ(anna.client.ask("TELL ball at x=1 #2"), "OK TELL");
  EXPECT_EQ(dora.client.ask("TELL is nobody there?"), "OK TELL");
  EXPECT_EQ(carl.hear(), Lines{});  // not before the next cycle
  goOn(all);
  EXPECT_EQ(carl.hear(), Lines{"0 anna ball at x=1 #2"});
  EXPECT_EQ(anna.hear(), Lines{});
  EXPECT_EQ(carl.client.ask("TELL robot=" + valueOf(carl.client.ask("HEAR"), "robot") + " mine"),
            "OK TELL");
  goOn(all);
  EXPECT_EQ(anna.hear(), (Lines{"0 carl mine", "0 polly anna says ball at x=1 #2"}));
  EXPECT_EQ(carl.hear(), Lines{"0 polly anna says ball at x=1 #2"});
  EXPECT_EQ(carl.hear(), Lines{});
  EXPECT_EQ(bert.hear(), Lines{});
  EXPECT_EQ(dora.hear(), Lines{});
  // Teams last as long as their robots: after a reset they are the same.
  EXPECT_TRUE(anna.client.ask("RESET").starts_with("OK RESET"));
  for (Mate* mate : {&bert, &carl, &dora}) EXPECT_EQ(mate->client.line(), "* RESET now=0");
  EXPECT_EQ(carl.client.ask("TELL again"), "OK TELL");
  goOn(all);
  EXPECT_EQ(anna.hear(), Lines{"0 carl again"});
  EXPECT_EQ(bert.hear(), Lines{});
}

TEST(TeamTalk, WhatCantBeToldIsRefused) {
  ServedSimulation world(kWorld, {.noise = false});
  const RunningBoard board(world, lockstepConfig());
  TestClient lonely(board.port());
  lonely.ask("HELLO ortung/1 name=eva");
  EXPECT_TRUE(lonely.ask("TELL hello").starts_with("ERR no-robot"));
  EXPECT_TRUE(lonely.ask("HEAR").starts_with("ERR no-robot"));
  lonely.send("CREATE eva team=b!ue\n" + kSensors + ".\n");
  EXPECT_EQ(lonely.line(), "ERR syntax a team is 1 to 32 of [A-Za-z0-9_-]");
  Mate anna(board.port(), "anna", "x_m=0.5 y_m=-1.5 team=blue");
  Mate bert(board.port(), "bert", "x_m=1.5 y_m=-1.5 team=blue");
  EXPECT_EQ(anna.client.ask("TELL robot=2 hello"),
            "ERR not-yours robot 2 belongs to another client");
  EXPECT_EQ(anna.client.ask("HEAR robot=2"), "ERR not-yours robot 2 belongs to another client");
  EXPECT_TRUE(anna.client.ask("TELL robot=x hello").starts_with("ERR number"));
  EXPECT_EQ(anna.client.ask("TELL " + std::string(400, 'x')), "OK TELL");
  EXPECT_EQ(anna.client.ask("TELL " + std::string(401, 'x')),
            "ERR limit robot anna has 401 characters to say, expected at most 400");
  for (int i = 1; i < 64; ++i) ASSERT_EQ(anna.client.ask("TELL more"), "OK TELL") << i;
  EXPECT_EQ(anna.client.ask("TELL more"),
            "ERR limit robot anna sends more than 64 messages in a cycle");
  EXPECT_EQ(bert.client.ask("TELL mine"), "OK TELL");  // the limit is each robot's own
  goOn({&anna, &bert});
  EXPECT_EQ(bert.hear().size(), 64u);
  EXPECT_EQ(anna.client.ask("TELL more"), "OK TELL");
}

/// Tells two things and notes what it hears, when.
class Asker : public Player {
 public:
  explicit Asker(std::vector<std::string>& notes) : notes_(notes) {}
  bool senseAndAct(PlayerSeat& seat) override {
    for (const Heard& heard : seat.heard())
      notes_.push_back(std::to_string(seat.now()) + ": " + heard.from + " at " +
                       std::to_string(heard.stamp) + ": " + heard.text);
    if (count_ == 1) seat.say("one");
    if (count_ == 4) {
      seat.say("two");
      seat.say("three");
    }
    return ++count_ < 10;
  }

 private:
  std::vector<std::string>& notes_;
  int count_ = 0;
};

TEST(TeamTalk, APlayerHearsTheSameAtTheSameTimeInsideAndOutside) {
  findTestPlayers();
  PluginFactory factory(PluginFactory::standardFolders());
  PlayerWish wish;
  wish.plugin = "asker";
  wish.team = "blue";
  std::vector<std::string> inside;
  {
    SceneRun run(Scene::open(kWorld), {.noise = false}, factory);
    run.addPlayer(parsePlayer(kParrot), 0);
    RobotConfig robot = readRobot(kRobot);
    robot.name = "anna";
    run.players().own(run.addRobot(robot, factory, Pose2{0.5, -1.5, 0.0}, 1),
                      std::make_unique<Asker>(inside), wish, Random(1));
    while (run.players().players().size() == 2) run.step();
  }
  std::vector<std::string> outside;
  ServedSimulation world(kWorld, {.noise = false});
  world.startPlayer(parsePlayer(kParrot));
  const RunningBoard board(world, lockstepConfig());
  RemotePlayConfig config;
  config.session.port = board.port();
  config.session.name = "anna";
  config.session.start = Pose2{0.5, -1.5, 0.0};
  config.plugin = wish.plugin;
  config.team = wish.team;
  config.robot = kRobot;
  config.isLockstep = true;
  RemotePlay(std::make_unique<Asker>(outside), config).run();
  ASSERT_EQ(inside.size(), 3u);
  EXPECT_TRUE(inside[0].ends_with(": anna says one")) << inside[0];
  EXPECT_EQ(inside, outside);
}

/// Notes where its mates see it.
class Seen : public Player {
 public:
  explicit Seen(std::vector<std::string>& notes) : notes_(notes) {}
  bool senseAndAct(PlayerSeat& seat) override {
    const SensorContainer::ReadLock lock = seat.container().read();
    const SensorData* position = seat.container().find({.feature = "position"});
    if (position->sequence() > 0 && position->stamp() > last_) {
      last_ = position->stamp();
      std::string note = std::to_string(seat.now()) + " " + std::to_string(last_);
      for (const std::uint32_t word : position->getData()) note += " " + std::to_string(word);
      notes_.push_back(note);
    }
    return seat.now() < fromSeconds(3.0);
  }

 private:
  std::vector<std::string>& notes_;
  Timestamp last_ = 0;
};

TEST(TeamTalk, IsAReadingInsideAndOutsideAlike) {
  const std::string blind = ORTUNG_SOURCE_DIR "/maps/robots/pioneer_blind.toml";
  const std::string lookout = "lookout:of=anna&start=-3,2,0@blue";
  constexpr Pose2 kStart{0.5, -1.5, 0.0};
  PluginFactory factory({ORTUNG_PLUGINS_DIR});
  PlayerWish wish;
  wish.plugin = "seen";
  wish.team = "blue";
  std::vector<std::string> inside;
  {
    SceneRun run(Scene::open(kWorld), {}, factory);
    run.addPlayer(parsePlayer(lookout), 0);
    RobotConfig robot = readRobot(blind);
    robot.name = "anna";
    run.players().own(run.addRobot(robot, factory, kStart, 1), std::make_unique<Seen>(inside), wish,
                      Random(1));
    while (run.players().players().size() == 2) run.step();
  }
  std::vector<std::string> outside;
  ServedSimulation world(kWorld, {});
  world.startPlayer(parsePlayer(lookout));
  const RunningBoard board(world, lockstepConfig());
  RemotePlayConfig config;
  config.session.port = board.port();
  config.session.name = "anna";
  config.session.start = kStart;
  config.plugin = wish.plugin;
  config.team = wish.team;
  config.robot = blind;
  config.isLockstep = true;
  RemotePlay(std::make_unique<Seen>(outside), config).run();
  EXPECT_GE(inside.size(), 20u);  // 0.1 s apart
  EXPECT_EQ(inside, outside);
}

}  // namespace
}  // namespace ortung::test

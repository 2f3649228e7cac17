// Players and their robots: who ends, who is told, and what that does to the others.
#include <gtest/gtest.h>
#include <time.h>

#include <chrono>
#include <cmath>
#include <functional>
#include <future>
#include <memory>
#include <optional>
#include <semaphore>
#include <thread>

#include "FakeWorld.hpp"
#include "WorldFiles.hpp"
#include "ortung/core/PluginGuard.hpp"
#include "ortung/robot/RobotFile.hpp"
#include "ortung/sim/PlayerControl.hpp"

namespace ortung {
namespace {

/// What a player does is said by the test.
struct ScriptedPlayer : Player {
  using Act = std::function<bool(PlayerSeat&)>;
  explicit ScriptedPlayer(Act act, double period = 0.0) : act_(std::move(act)), period_(period) {}
  double period() const override { return period_; }
  bool senseAndAct(PlayerSeat& seat) override { return act_(seat); }
  void end(PlayerSeat&) override {
    if (ended != nullptr) ++*ended;
  }

  int* ended = nullptr;

 private:
  Act act_;
  double period_;
};

RobotConfig robotNamed(const std::string& name) {
  const test::TemporaryFolder folder;
  RobotConfig config = readRobot(folder.write("r.toml",
                                              "[robot]\nradius_m = 0.2\n[[sensor]]\n"
                                              "plugin = \"odometry\"\n"));
  config.name = name;
  return config;
}

struct Field {
  explicit Field(double budget = 1.0)
      : factory(PluginFactory::standardFolders()),
        simulation(std::make_unique<FakeWorld>(18.0, 12.0), {.cycle = 0.01, .seed = 3}),
        plans(simulation.world()),
        players(simulation, plans, factory,
                {budget, [this](const std::string& problem) { problems.push_back(problem); }}) {}

  SimRobot& start(const std::string& name, const Pose2& pose, ScriptedPlayer::Act act,
                  const std::string& team = "", double period = 0.0, int* ended = nullptr) {
    SimRobot& robot = simulation.addRobot(robotNamed(name), factory, pose);
    auto player = std::make_unique<ScriptedPlayer>(std::move(act), period);
    player->ended = ended;
    PlayerWish wish;
    wish.plugin = "scripted";
    wish.team = team;
    players.own(robot, std::move(player), wish, Random(7));
    return robot;
  }
  void step(int cycles = 1) {
    for (int i = 0; i < cycles; ++i) {
      simulation.sense();
      players.act(game);
      simulation.move();
      players.clear();
    }
  }

  PluginFactory factory;
  Simulation simulation;
  FloorPlans plans;
  std::vector<std::string> problems;
  PlayerControl players;
  Game game;
};

bool ahead(PlayerSeat& seat) {
  seat.robot().setTranslationalVelocity(0.5);
  return true;
}

TEST(PlayerControl, ActsOnWhatIsSensedInTheSameCycle) {
  Field field;
  std::vector<Timestamp> stamps;
  field.start("anna", {0, 0, 0}, [&](PlayerSeat& seat) {
    const auto odometry = seat.container().find({.type = "odometry"});
    EXPECT_EQ(odometry->stamp(), seat.now() / 50'000 * 50'000) << "its period is 50 ms";
    stamps.push_back(seat.now());
    return ahead(seat);
  });
  field.step(100);
  ASSERT_EQ(stamps.size(), 100u);
  EXPECT_EQ(stamps.front(), 0);
  EXPECT_EQ(stamps.back(), 990'000);
  EXPECT_GT(field.simulation.robots()[0]->state().pose.x, 0.2);
}

/// What abandon() says, for which it has a minute whatever its patience is. What is abandoned waits
/// for the program's end, so it is never destroyed.
std::optional<bool> abandoned(PlayerControl& players, std::chrono::duration<double> patience) {
  const auto promise = std::make_shared<std::promise<bool>>();
  std::future<bool> haveEnded = promise->get_future();
  std::thread([&players, promise, patience] {
    promise->set_value(players.abandon(patience));
  }).detach();
  if (haveEnded.wait_for(std::chrono::minutes(1)) != std::future_status::ready) return std::nullopt;
  return haveEnded.get();
}

TEST(PlayerControl, EndsAllPlayersOfAProgramThatHangsElsewhere) {
  static auto* const field = new Field;  // NOLINT(cppcoreguidelines-owning-memory)
  static int ended = 0;
  field->start("anna", {0, 0, 0}, ahead, "blue", 0.0, &ended);
  field->start("bert", {2, 0, 0}, ahead, "blue", 0.0, &ended);
  field->step(2);
  EXPECT_EQ(abandoned(field->players, std::chrono::milliseconds(200)), true)
      << "it waits for a call that nobody is in";
  EXPECT_EQ(ended, 2);
}

TEST(PlayerControl, EndsAllPlayersButTheOneThatHangsAtOnce) {
  static auto* const field = new Field;  // NOLINT(cppcoreguidelines-owning-memory)
  static int ended = 0;
  static int hung = 0;
  static std::promise<void> isIn;
  static std::binary_semaphore never(0);
  const auto hang = [](PlayerSeat&) {
    isIn.set_value();
    never.acquire();
    return true;
  };
  field->start("anna", {0, 0, 0}, hang, "blue", 0.0, &hung);
  field->start("bert", {2, 0, 0}, ahead, "blue", 0.0, &ended);
  std::thread([] { field->step(); }).detach();
  ASSERT_EQ(isIn.get_future().wait_for(std::chrono::minutes(1)), std::future_status::ready);
  EXPECT_EQ(abandoned(field->players, std::chrono::hours(1)), true)
      << "it waits although it is known who hangs";
  EXPECT_EQ(ended, 1);
  EXPECT_EQ(hung, 0);
}

TEST(PlayerControl, KeepsToThePeriodOfAPlayer) {
  Field field;
  std::vector<Timestamp> stamps;
  field.start(
      "anna", {0, 0, 0},
      [&](PlayerSeat& seat) {
        stamps.push_back(seat.now());
        return true;
      },
      "", 0.025);
  field.step(20);
  EXPECT_EQ(stamps, (std::vector<Timestamp>{0, 30'000, 50'000, 80'000, 100'000, 130'000, 150'000,
                                            180'000}));
}

TEST(PlayerControl, TakesTheRobotOffWhenThePlayerHasAccomplishedItsTask) {
  Field field;
  int calls = 0;
  int ended = 0;
  field.start("anna", {0, 0, 0}, [&](PlayerSeat&) { return ++calls < 3; }, "blue", 0.0, &ended);
  field.start("bert", {2, 0, 0}, ahead);
  field.step(10);
  EXPECT_EQ(calls, 3);
  EXPECT_EQ(ended, 1);
  ASSERT_EQ(field.simulation.robots().size(), 1u);
  EXPECT_EQ(field.simulation.robots()[0]->config().name, "bert");
  EXPECT_EQ(field.players.players().size(), 1u);
  EXPECT_EQ(field.players.teamOf("anna"), "");
  EXPECT_TRUE(field.problems.empty());
}

TEST(PlayerControl, EndsThePlayerWhenItsRobotLeaves) {
  Field field;
  int calls = 0;
  int ended = 0;
  SimRobot& robot =
      field.start("anna", {0, 0, 0}, [&](PlayerSeat&) { return ++calls > 0; }, "", 0.0, &ended);
  field.step(3);
  field.simulation.removeRobot(robot);
  field.step(3);
  EXPECT_EQ(calls, 3);
  EXPECT_EQ(ended, 0) << "there is no seat any more";
  EXPECT_TRUE(field.players.isEmpty());
}

TEST(PlayerControl, EndsAllWhoPlayAtTheEndOfARun) {
  int anna = 0;
  int bert = 0;
  {
    Field field;
    field.start("anna", {0, 0, 0}, ahead, "", 0.0, &anna);
    field.start("bert", {2, 0, 0}, ahead, "", 0.0, &bert);
    field.step(3);
    EXPECT_EQ(anna + bert, 0);
    field.players.endAll();
    EXPECT_EQ(anna, 1);
    EXPECT_EQ(bert, 1);
    EXPECT_TRUE(field.players.isEmpty());
    EXPECT_EQ(field.simulation.robots().size(), 2u) << "they stay where the run has ended";
  }
  EXPECT_EQ(anna, 1) << "once is enough";
  {
    Field field;
    field.start("anna", {0, 0, 0}, ahead, "", 0.0, &anna);
  }
  EXPECT_EQ(anna, 2) << "whoever forgets to say that the run is over";
}

TEST(PlayerControl, StopsAPlayerByItsRobotsName) {
  Field field;
  int ended = 0;
  field.start("anna", {0, 0, 0}, ahead, "", 0.0, &ended);
  EXPECT_FALSE(field.players.stop("bert"));
  EXPECT_TRUE(field.players.stop("anna"));
  field.step();
  EXPECT_EQ(ended, 1);
  EXPECT_TRUE(field.simulation.robots().empty());
}

struct Wrong {
  const char* name;
  ScriptedPlayer::Act act;
  const char* message;
};

TEST(PlayerControl, WhatAPlayerDoesWrongEndsThatOneAloneAndNamesIt) {
  const std::vector<Wrong> wrongs = {
      {"throws", [](PlayerSeat&) -> bool { throw std::runtime_error("no idea"); }, "no idea"},
      {"throws what is no error", [](PlayerSeat&) -> bool { throw 5; }, "no std::exception"},
      {"commands NaN",
       [](PlayerSeat& seat) {
         seat.robot().setTranslationalVelocity(std::nan(""));
         return true;
       },
       "translational"},
      {"commands wheels that are not there",
       [](PlayerSeat& seat) {
         seat.robot().setMotion(std::vector<double>(7, 0.0));
         return true;
       },
       "7"},
      {"says a novel",
       [](PlayerSeat& seat) {
         seat.say(std::string(401, 'x'));
         return true;
       },
       "at most 400"},
      {"says a line feed",
       [](PlayerSeat& seat) {
         seat.say("a\nb");
         return true;
       },
       "printable"},
  };
  const auto poseOfBert = [](const ScriptedPlayer::Act* wrong, Field& field) {
    field.start("bert", {2, 0, 0.3}, ahead);
    if (wrong != nullptr) field.start("anna", {-2, 0, 0}, *wrong);
    field.step(50);
    return field.simulation.robots()[0]->state().pose;
  };
  Field alone;
  const Pose2 expected = poseOfBert(nullptr, alone);
  for (const Wrong& wrong : wrongs) {
    SCOPED_TRACE(wrong.name);
    Field field;
    const Pose2 pose = poseOfBert(&wrong.act, field);
    EXPECT_EQ(pose.x, expected.x);
    EXPECT_EQ(pose.y, expected.y);
    EXPECT_EQ(pose.theta, expected.theta);
    EXPECT_EQ(field.simulation.robots().size(), 1u);
    ASSERT_EQ(field.problems.size(), 1u);
    EXPECT_NE(field.problems[0].find("the player 'scripted' of robot anna"), std::string::npos)
        << field.problems[0];
    EXPECT_NE(field.problems[0].find(wrong.message), std::string::npos) << field.problems[0];
  }
}

TEST(PlayerControl, StopsAPlayerThatTakesTooMuchOfAProcessor) {
  Field field(0.002);
  field.start("anna", {0, 0, 0}, [](PlayerSeat& seat) {
    const auto used = [] {
      timespec time{};
      ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
      return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
    };
    const double begin = used();
    while (seat.now() >= 30'000 && used() - begin < 0.003) {
    }
    return true;
  });
  field.step(2);
  EXPECT_TRUE(field.problems.empty());
  field.step(2);
  ASSERT_EQ(field.problems.size(), 1u);
  EXPECT_NE(field.problems[0].find("expected at most 0.002"), std::string::npos)
      << field.problems[0];
  EXPECT_TRUE(field.simulation.robots().empty());
  EXPECT_THROW(PlayerControl(field.simulation, field.plans, field.factory, {.budget = -1.0}),
               std::invalid_argument);
}

TEST(PlayerControl, CarriesWhatIsSaidToTheTeamInTheNextCycle) {
  Field field;
  std::vector<std::string> heard;
  const auto listener = [&](const char* who) {
    return [&heard, who](PlayerSeat& seat) {
      for (const Heard& one : seat.heard())
        heard.push_back(std::string(who) + "@" + std::to_string(seat.now()) + ":" + one.from + "@" +
                        std::to_string(one.stamp) + " " + one.text);
      return true;
    };
  };
  field.start("early", {-4, 0, 0}, listener("early"), "blue");
  field.start(
      "anna", {0, 0, 0},
      [](PlayerSeat& seat) {
        if (seat.now() == 20'000) seat.say("mine");
        EXPECT_TRUE(seat.heard().empty()) << "not its own words";
        return true;
      },
      "blue");
  field.start("late", {2, 0, 0}, listener("late"), "blue");
  field.start("slow", {4, 0, 0}, listener("slow"), "blue", 0.05);
  field.start("other", {6, 0, 0}, listener("other"), "yellow");
  field.start("none", {8, 0, 0}, listener("none"));
  field.step(12);
  EXPECT_EQ(heard,
            (std::vector<std::string>{"early@30000:anna@20000 mine", "late@30000:anna@20000 mine",
                                      "slow@50000:anna@20000 mine"}));
}

/// Wants what nobody can give, or throws when it is asked.
struct Demanding : ScriptedPlayer {
  Demanding(double period, bool throws)
      : ScriptedPlayer([](PlayerSeat&) { return true; }, period), throws_(throws) {}
  bool needsStage() const override {
    if (throws_) throw 5;
    return false;
  }

 private:
  bool throws_;
};

TEST(PlayerControl, APlayerThatWantsWhatIsNoneIsRefusedByName) {
  Field field;
  SimRobot& robot = field.simulation.addRobot(robotNamed("anna"), field.factory, {});
  PlayerWish wish;
  wish.plugin = "demanding";
  for (const double period : {-1.0, std::nan(""), HUGE_VAL, 0.0}) {
    try {
      field.players.own(robot, std::make_unique<Demanding>(period, period == 0.0), wish, Random(1));
      ADD_FAILURE() << period;
    } catch (const PluginFailure& failure) {
      EXPECT_NE(std::string(failure.what()).find("the player 'demanding'"), std::string::npos);
    }
  }
  EXPECT_TRUE(field.players.isEmpty());
}

TEST(PlayerControl, OneRobotHasOnePlayer) {
  Field field;
  SimRobot& robot = field.start("anna", {0, 0, 0}, ahead);
  PlayerWish wander;
  wander.plugin = "wander";
  EXPECT_THROW(field.players.lead(robot, wander, Random(1)), std::invalid_argument);
  wander.plugin = "nobody";
  EXPECT_THROW(field.players.lead(robot, wander, Random(1)), PluginError);
}

TEST(PlayerControl, ShowsPlayersTheStageAndLetsThemChangeIt) {
  Field field;
  field.start("bert", {2, 0, 0}, ahead, "yellow");
  field.start("anna", {0, 0, 0}, [](PlayerSeat& seat) {
    Stage& stage = *seat.stage();
    EXPECT_EQ(stage.robots().size(), 2u);
    EXPECT_EQ(stage.robots()[0].team, "yellow");
    if (seat.now() == 100'000) {
      EXPECT_GT(stage.robots()[0].velocity.x, 0.05);
      stage.placeRobot("bert", {-3, 1, 0});
      EXPECT_EQ(stage.robots()[0].pose.x, -3.0) << "at once";
      EXPECT_THROW(stage.placeRobot("bert", seat.stage()->robots()[1].pose), NoRoom);
      EXPECT_THROW(stage.placeRobot("carl", {}), std::invalid_argument);
      EXPECT_THROW(stage.placeThing("ball", {}), std::invalid_argument);
    }
    return true;
  });
  field.step(12);
  EXPECT_LT(field.simulation.robots()[0]->state().pose.x, -2.8);
}

// Whatever it is told: the referee has placed it.
TEST(PlayerControl, ARobotThatIsHeldStands) {
  Field field;
  SimRobot& robot = field.start("anna", {0, 0, 0}, ahead);
  robot.hold(true);
  field.step(50);
  EXPECT_EQ(robot.state().pose.x, 0.0);
  robot.hold(false);
  field.step(50);
  EXPECT_GT(robot.state().pose.x, 0.05);
}

}  // namespace
}  // namespace ortung

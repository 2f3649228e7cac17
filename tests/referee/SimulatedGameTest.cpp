// The referee in the real simulation: robots that drive and kick, a ball that rolls and bounces.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <vector>

#include "Files.hpp"
#include "Paths.hpp"
#include "ortung/base/Angles.hpp"
#include "ortung/core/PluginFactory.hpp"
#include "ortung/robot/RobotFile.hpp"
#include "ortung/robot/TomlFile.hpp"
#include "ortung/sim/PlayerControl.hpp"
#include "ortung/sim/Simulation.hpp"
#include "ortung/sim_api/Referee.hpp"

namespace ortung {
namespace {

/// As msl_omni, but for sensors and wheels: a body with an opening, and a kicker in it.
constexpr const char* kRobot = R"(
radius_m = 0.4
mass_kg = 30
[[body]]
shape = "rectangle"
center_m = [-0.04, 0]
size_m = [0.42, 0.5]
[[body]]
shape = "rectangle"
center_m = [0.205, 0.195]
size_m = [0.07, 0.11]
[[body]]
shape = "rectangle"
center_m = [0.205, -0.195]
size_m = [0.07, 0.11]
[[manipulator]]
name = "kicker"
[[manipulator.state]]
name = "rest"
[[manipulator.state]]
name = "kick"
ball_speed_m_s = 8.0
returns_after_s = 0.2
[[manipulator.state.body]]
shape = "rectangle"
center_m = [0.2, 0]
size_m = [0.06, 0.2]
z_m = [0.05, 0.2]
[drive]
plugin = "differential"
body_height_m = 0.6
[[sensor]]
plugin = "odometry"
)";

/// The first letter of a robot's name is that of its team.
class SimulatedGame {
 public:
  explicit SimulatedGame(const std::string& rules, std::uint64_t seed = 1)
      : simulation_(readWorld(ORTUNG_SOURCE_DIR "/maps/fields/msl.toml"), {.seed = seed}),
        plans_(simulation_.world()),
        control_(simulation_, plans_, factory_, {}) {
    test::writeBytes(folder_ / "rules.toml", rules);
    Parameters p("test");
    p.set("rules", (folder_ / "rules.toml").string());
    referee_ = factory_.make<Referee>("soccer", p);
  }

  void add(const std::string& name, const Pose2& pose) {
    const std::string text = "[robot]\nname = \"" + name + "\"\n" + kRobot;
    simulation_.addRobot(readRobot(parseToml(text, name)), factory_, pose);
    control_.setTeam(name, name[0] == 'b' ? "blue" : "yellow");
  }
  SimRobot& robot(std::size_t i) { return *simulation_.robots()[i]; }
  Simulation& simulation() { return simulation_; }
  Referee& referee() { return *referee_; }
  const Game& game() const { return game_; }
  std::map<std::string, int>& count() { return count_; }
  const Simulation::Thing& ball() const { return simulation_.things()[0]; }

  /// One cycle. @param act what robots do that are not held
  template <class Act>
  void step(const Act& act) {
    game_ = referee_->watch(control_.stage());
    for (const RefereeEvent& event : referee_->takeEvents()) {
      ++count_[event.what];
      log_ += std::to_string(event.stamp) + " " + event.what + " " + event.team + "\n";
    }
    for (std::size_t i = 0; i < simulation_.robots().size(); ++i) {
      if (referee_->holds(robot(i).config().name)) {
        robot(i).setTranslationalVelocity(0.0);
        robot(i).setRotationalVelocity(0.0);
      } else {
        act(robot(i));
      }
    }
    simulation_.step();
  }
  const std::string& log() const { return log_; }

 private:
  test::TemporaryFolder folder_;
  PluginFactory factory_{PluginFactory::standardFolders()};
  Simulation simulation_;
  FloorPlans plans_;
  PlayerControl control_;
  std::unique_ptr<Referee> referee_;
  Game game_;
  std::map<std::string, int> count_;
  std::string log_;
};

const std::string kDirect =
    "base = \"msl\"\n[goal]\ndirect_from = [\"kick-off\", \"free-kick\", \"penalty\", \"corner\", "
    "\"goal-kick\", \"throw-in\", \"dropped-ball\"]\n";

void stand(SimRobot& robot) {
  robot.setTranslationalVelocity(0.0);
  robot.setRotationalVelocity(0.0);
}

/// Everybody may play, and things are where a test wants them.
void playOn(SimulatedGame& game, const Pose2& ball, const std::vector<Pose2>& robots) {
  game.referee().order("dropped-ball");
  game.referee().order("start");
  game.step(stand);
  ASSERT_EQ(game.game().phase, Game::Phase::kPlaying);
  for (int round = 0; round < 2; ++round)  // the first may stand in the second's way
    for (std::size_t i = 0; i < robots.size(); ++i) try {
        game.simulation().place(game.robot(i), robots[i]);
      } catch (const NoRoom&) {
        EXPECT_EQ(round, 0);
      }
  game.simulation().placeThing(0, ball);
}

TEST(SimulatedGame, ARobotKicksTheBallIntoTheGoal) {
  SimulatedGame game(kDirect);
  game.add("b1", {-3, 0, 0});
  game.add("y1", {3, 0, 0});
  playOn(game, {8.36, 0.3, 0}, {{8, 0.3, 0}, {5, -4, 0}});
  for (int i = 0; i < 100; ++i)
    game.step([&](SimRobot& robot) {
      if (&robot == &game.robot(0) && i == 10) robot.setManipulator("kicker", "kick");
    });
  EXPECT_EQ(game.game().teams[0].score, 1) << game.log();
  EXPECT_EQ(game.game().restart, Game::Restart::kKickOff);
  EXPECT_EQ(game.game().restartOf, 1U);
  EXPECT_NEAR(std::hypot(game.ball().pose.x, game.ball().pose.y), 0.0, 0.01);
  EXPECT_LT(game.robot(0).state().pose.x, 0.0);
}

TEST(SimulatedGame, ARobotPushesTheBallOverTheTouchLine) {
  SimulatedGame game(kDirect);
  game.add("b1", {-3, 0, 0});
  game.add("y1", {3, 0, 0});
  playOn(game, {2, 6.3, 0}, {{2, 5.8, 90 * kDegree}, {-5, -4, 0}});
  for (int i = 0; i < 200 && game.game().phase == Game::Phase::kPlaying; ++i)
    game.step([&](SimRobot& robot) {
      robot.setTranslationalVelocity(&robot == &game.robot(0) ? 1.0 : 0.0);
    });
  EXPECT_EQ(game.game().restart, Game::Restart::kThrowIn) << game.log();
  EXPECT_EQ(game.game().restartOf, 1U);
  EXPECT_NEAR(game.ball().pose.x, 2.0, 0.1);
  EXPECT_NEAR(game.ball().pose.y, 7.0, 1e-3);
}

/// What counts is the body, not the circle around it.
TEST(SimulatedGame, ABallThatPassesBesideTheBodyWasNotTouched) {
  SimulatedGame game(kDirect);
  game.add("b1", {-3, 0, 0});
  game.add("y1", {3, 0, 0});
  playOn(game, {0, 0, 0}, {{-2, 6, 0}, {5, 0, 0}});
  game.simulation().placeThing(0, {-2, 6.46, 0}, {0, 2, 0});
  for (int i = 0; i < 200 && game.game().phase == Game::Phase::kPlaying; ++i) game.step(stand);
  EXPECT_EQ(game.game().restart, Game::Restart::kThrowIn) << game.log();
  EXPECT_EQ(game.game().restartOf, 0U) << "nobody touched it in the half of blue";
}

/// A ball of 8 m/s bounces off within a cycle, in which it goes 8 cm.
TEST(SimulatedGame, AFastBallThatBouncesOffARobotWasTouchedByIt) {
  for (int shift = 0; shift < 8; ++shift) {
    SimulatedGame game(kDirect);
    game.add("b1", {-3, 0, 0});
    game.add("y1", {3, 0, 0});
    playOn(game, {9.2 - 0.01 * shift, -5, 0}, {{-8, 0, 0}, {9.3, -3.3, -80 * kDegree}});
    game.simulation().placeThing(0, {9.2, -6.0 - 0.01 * shift, 0}, {0, 8, 0});
    for (int i = 0; i < 400 && game.game().phase == Game::Phase::kPlaying; ++i) game.step(stand);
    EXPECT_NE(game.game().phase, Game::Phase::kPlaying);
    // Of a ball that nobody touched it would be yellow's: its half.
    EXPECT_EQ(game.game().restartOf, 0U) << shift << "\n" << game.log();
  }
}

/// Turns to the ball, drives, and kicks what is before it.
void chase(SimulatedGame& game, SimRobot& robot) {
  const Pose2& pose = robot.state().pose;
  const Pose2 ball = inverse(pose) * game.ball().pose;
  const double bearing = std::atan2(ball.y, ball.x);
  robot.setRotationalVelocity(3.0 * bearing);
  robot.setTranslationalVelocity(std::abs(bearing) < 0.5 ? 1.5 : 0.2);
  const bool isBefore = ball.x > 0.2 && ball.x < 0.4 && std::abs(ball.y) < 0.1;
  if (isBefore) robot.setManipulator("kicker", "kick");
}

/// What must hold whatever happens in a game of ten robots that all chase the ball.
class Chase {
 public:
  Chase() : game_(kDirect + "[match]\nhalf_s = 25\n[stuck]\ntime_s = 3\n", 5) {
    for (int i = 0; i < 5; ++i) {
      game_.add("b" + std::to_string(i), {-8.0 + i, 2.0, 0.0});
      game_.add("y" + std::to_string(i), {8.0 - i, -2.0, 3.0});
    }
  }

  const std::string& play() {
    Game before;
    for (int i = 0; i < 6000; ++i) {
      game_.step([this](SimRobot& robot) { chase(game_, robot); });
      const Game& now = game_.game();
      if (now.phase == Game::Phase::kReady && before.phase == Game::Phase::kStopped)
        expectDistances(now);
      if (now.phase == Game::Phase::kPlaying) {
        EXPECT_LT(std::abs(game_.ball().pose.x), 11.5) << game_.log();
        EXPECT_LT(std::abs(game_.ball().pose.y), 7.5) << game_.log();
      }
      before = now;
    }
    EXPECT_EQ(before.phase, Game::Phase::kOver);
    EXPECT_EQ(before.teams[0].score + before.teams[1].score, game_.count()["goal"]);
    EXPECT_EQ(game_.count()["half-time"], 1);
    EXPECT_EQ(game_.count()["problem"], 0) << game_.log();
    EXPECT_GE(game_.count()["play"], 2) << "each half is kicked off\n" << game_.log();
    EXPECT_GT(game_.count()["set-piece-over"], 1) << game_.log();
    return game_.log();
  }

 private:
  void expectDistances(const Game& now) {
    for (const auto& robot : game_.simulation().robots()) {
      const Pose2& pose = robot->state().pose;
      const bool isBlue = robot->config().name[0] == 'b';
      const double end = (isBlue ? 0U : 1U) == now.teamOnTheLeft ? -1.0 : 1.0;
      const bool isKeeper = std::abs(pose.y) < 3.45 && pose.x * end > 8.75;
      if ((isBlue ? 0U : 1U) == now.restartOf || isKeeper) continue;
      const double keepAway = now.restart == Game::Restart::kKickOff ? 2.0 : 3.0;
      EXPECT_GT(distance(pose, game_.ball().pose) - 0.4 - 0.11, keepAway - 0.05)
          << robot->config().name << "\n"
          << game_.log();
    }
  }

  SimulatedGame game_;
};

TEST(SimulatedGame, OfTenRobotsGoesByTheRulesAndAlwaysTheSameWay) {
  const std::string first = Chase().play();
  EXPECT_EQ(Chase().play(), first);
  RecordProperty("log", first);
}

}  // namespace
}  // namespace ortung

#include <gtest/gtest.h>

#include <cmath>

#include "Paths.hpp"
#include "WorldFiles.hpp"
#include "ortung/sim/PlayerControl.hpp"
#include "ortung/sim/SceneRun.hpp"

namespace ortung::test {
namespace {

/// The scene that ships, played for some time.
struct Played {
  explicit Played(double seconds, const Simulation::Config& config = {}) {
    const Scene scene = Scene::read(ORTUNG_SOURCE_DIR "/maps/scenes/kick.toml");
    run = std::make_unique<SceneRun>(scene, config, factory);
    while (toSeconds(run->simulation().now()) < seconds) run->step();
  }
  const SimRobot& robot(const std::string& name) const {
    return *run->simulation().robots()[run->find(name).value()];
  }
  const Simulation::Thing& ball() const { return run->simulation().things()[0]; }

  PluginFactory factory{PluginFactory::standardFolders()};
  std::unique_ptr<SceneRun> run;
};

double speedOf(const Twist& velocity) { return std::hypot(velocity.x, velocity.y); }

TEST(Scene, DribblesTheBallRoundTwoCurves) {
  const Played play(7.0);
  EXPECT_GT(play.ball().pose.y, 1.0);  // it has come along, away from where it lay
  EXPECT_LT(distance(play.ball().pose, play.robot("striker").state().pose), 0.35);
}

TEST(Scene, KicksTheBallIntoTheGoal) {
  const Played before(8.45);
  const Played after(8.52);
  const double own = speedOf(before.robot("striker").state().velocity);
  EXPECT_NEAR(speedOf(after.ball().velocity), 8.0 + own, 0.2);  // what the kicker's state says
  const Played later(10.0);
  EXPECT_GT(later.ball().pose.x, 11.0);
  EXPECT_LT(std::abs(later.ball().pose.y), 1.2);
}

TEST(Scene, RobotsThatCollidePushEachOther) {
  const Played play(6.0);
  EXPECT_LT(play.robot("pusher").state().pose.x, -1.5);  // it began at -1 and drove forwards
  EXPECT_GT(distance(play.robot("pusher").state().pose, play.robot("defender").state().pose), 0.4);
}

/// A room with a ball, and a robot in it with a kicker.
struct Kicker {
  explicit Kicker(const std::string& more = "")
      : robotFile(folder.write("robot.toml", R"(
[robot]
name = "kicker"
radius_m = 0.2
mass_kg = 20
[[sensor]]
plugin = "odometry"
[[manipulator]]
name = "kicker"
[[manipulator.state]]
name = "rest"
[[manipulator.state]]
name = "kick"
ball_speed_m_s = 5
returns_after_s = 0.1
[[manipulator.state.body]]
center_m = [0.22, 0]
size_m = [0.06, 0.2]
z_m = [0, 0.3]
)" + more)),
        worldFile(folder.write("world.toml", R"(
[world]
x_m = [-5, 5]
y_m = [-5, 5]
[[rectangle]]
kind = "wall"
center_m = [0, 5.1]
size_m = [10, 0.2]
[[ellipse]]
kind = "ball"
name = "ball"
center_m = [0.32, 0]
size_m = [0.22, 0.22]
z_m = [0, 0.22]
)")),
        simulation(readWorld(worldFile), {}),
        robot(simulation.addRobot(readRobot(robotFile), factory, {0, 0, 0})) {}

  /// The same robot in a scene, named "one", and what that is told.
  SceneRobot inScene(const std::optional<Pose2>& start) const {
    SceneRobot its;
    its.file = robotFile;
    its.name = "one";
    its.start = start;
    return its;
  }
  static SceneCommand kickAt(Timestamp at) {
    SceneCommand command;
    command.at = at;
    command.robot = "one";
    command.manipulator = "kicker";
    command.state = "kick";
    return command;
  }

  TemporaryFolder folder;
  std::filesystem::path robotFile, worldFile;
  PluginFactory factory{PluginFactory::standardFolders()};
  Simulation simulation;
  SimRobot& robot;
};

TEST(Manipulator, GivesTheBallTheSpeedOfItsState) {
  Kicker kicker;
  kicker.simulation.step();
  EXPECT_EQ(speedOf(kicker.simulation.things()[0].velocity), 0.0);
  kicker.robot.setManipulator("kicker", "kick");
  kicker.simulation.step();
  const Twist ball = kicker.simulation.things()[0].velocity;
  EXPECT_NEAR(ball.x, 5.0, 0.01);
  EXPECT_NEAR(ball.y, 0.0, 0.01);
}

TEST(Manipulator, KicksOnlyWhatItReaches) {
  Kicker kicker;
  kicker.simulation.placeThing(0, {0.6, 0.0, 0.0});
  kicker.robot.setManipulator("kicker", "kick");
  kicker.simulation.step();
  EXPECT_EQ(speedOf(kicker.simulation.things()[0].velocity), 0.0);
}

TEST(Manipulator, MovesRealGeometryAndReturns) {
  Kicker kicker;
  kicker.simulation.placeThing(0, {3.0, 3.0, 0.0});
  const auto ahead = [&] { return rangeAt(kicker.simulation.world(), 1.0, 0.0, 3.14159265, 0.1); };
  EXPECT_NEAR(ahead(), 0.8, 1e-3);
  kicker.robot.setManipulator("kicker", "kick");
  kicker.simulation.step();
  EXPECT_NEAR(ahead(), 0.75, 1e-3);  // rays meet it
  EXPECT_THROW(kicker.simulation.placeThing(0, {0.34, 0.0, 0.0}),
               std::invalid_argument);  // bodies, too
  for (int i = 2; i <= 10; ++i) {       // 0.1 s in cycles of 10 ms
    kicker.simulation.step();
    EXPECT_NEAR(ahead(), 0.75, 1e-3) << i;
  }
  kicker.simulation.step();
  EXPECT_NEAR(ahead(), 0.8, 1e-3);
  kicker.simulation.placeThing(0, {0.34, 0.0, 0.0});
}

TEST(Manipulator, IsNamedWhenItIsNotThere) {
  Kicker kicker;
  const auto complaint = [&](const char* manipulator, const char* state) -> std::string {
    try {
      kicker.robot.setManipulator(manipulator, state);
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(complaint("arm", "up"), "robot kicker has no manipulator 'arm'; it has kicker");
  EXPECT_EQ(complaint("kicker", "up"),
            "robot kicker: its manipulator kicker has no state 'up'; it has rest, kick");
}

TEST(RobotCommands, AreGivenByNumberOfAStateToo) {
  Kicker kicker;
  RobotCommands& commands = kicker.robot;
  commands.setManipulator("kicker", "1");
  kicker.simulation.step();
  EXPECT_EQ(kicker.robot.manipulatorStates()[0], 1u);
  EXPECT_THROW(commands.setManipulator("kicker", "2"), std::invalid_argument);
}

TEST(RobotCommands, EndTheGuestOnceTheyAreTaken) {
  Kicker kicker;
  RobotCommands& commands = kicker.robot;
  kicker.simulation.placeThing(0, {3.0, 3.0, 0.0});
  FloorPlans plans(kicker.simulation.world());
  PluginFactory factory(PluginFactory::standardFolders());
  PlayerControl players(kicker.simulation, plans, factory, {});
  PlayerWish ahead;
  ahead.plugin = "follow";
  const Pose2 far = kicker.robot.state().pose * Pose2{50.0, 0.0, 0.0};
  ahead.options.set("waypoints_m", std::vector<double>{far.x, far.y});
  players.lead(kicker.robot, ahead, Random(1));
  const auto way = [&] {
    const double before = kicker.robot.state().pose.x;
    for (int i = 0; i < 100; ++i) {
      kicker.simulation.sense();
      players.act({});
      kicker.simulation.move();
      players.clear();
    }
    return kicker.robot.state().pose.x - before;
  };
  EXPECT_THROW(commands.setTranslationalVelocity(std::nan("")), std::invalid_argument);
  EXPECT_THROW(commands.setMotion(std::vector<double>{1.0}), std::invalid_argument);
  commands.setManipulator("kicker", "kick");
  EXPECT_GT(way(), 0.1);
  EXPECT_EQ(players.players().size(), 1u);
  commands.setTranslationalVelocity(0.0);
  way();  // brakes
  EXPECT_EQ(way(), 0.0);
  EXPECT_TRUE(players.players().empty());
  EXPECT_EQ(kicker.simulation.robots().size(), 1u) << "the robot stays";
}

TEST(SceneRun, CarriesARobotElsewhereWithoutItsOdometry) {
  const Kicker kicker;  // its files
  Scene scene;
  scene.world = kicker.worldFile;
  SceneRobot robot;
  robot.file = kicker.robotFile;
  robot.name = "lost";
  robot.start = Pose2{1.0, 1.0, 0.0};
  robot.kidnaps = {0, 50'000};
  scene.robots.push_back(robot);
  PluginFactory factory(PluginFactory::standardFolders());
  SceneRun run(scene, {.noise = false}, factory);
  const SimRobot& lost = *run.simulation().robots().front();
  std::vector<Pose2> places = {lost.state().pose};
  while (run.simulation().now() < 200'000) {
    run.step();
    if (distance(places.back(), lost.state().pose) > 0.0) places.push_back(lost.state().pose);
  }
  EXPECT_EQ(places.size(), 3u);
  EXPECT_EQ(distance(lost.state().odometry, Pose2{}), 0.0);
}

TEST(SceneRun, WhatTheScriptSaysIsDoneInTheCycleThatBeginsThen) {
  const Kicker kicker;  // its files
  Scene scene;
  scene.world = kicker.worldFile;
  scene.robots.push_back(kicker.inScene(Pose2{}));
  scene.commands.push_back(Kicker::kickAt(20'000));
  scene.placements.push_back({30'000, "ball", {3.0, 3.0, 0.0}, {}});
  PluginFactory factory(PluginFactory::standardFolders());
  SceneRun run(scene, {.cycle = 0.01}, factory);
  std::vector<std::size_t> states;
  std::vector<bool> isPlaced;
  for (int cycle = 0; cycle < 5; ++cycle) {
    run.step();
    states.push_back(run.simulation().robots().front()->manipulatorStates()[0]);
    isPlaced.push_back(run.simulation().things()[0].pose.y > 2.0);
  }
  EXPECT_EQ(states, (std::vector<std::size_t>{0, 0, 1, 1, 1}));
  EXPECT_EQ(isPlaced, (std::vector<bool>{false, false, false, true, true}));
}

/// The message with which a scene in the arena ends at its beginning, or "".
std::string refusalOfScene(const std::string& robots) {
  const TemporaryFolder folder;
  const std::string head = "[scene]\nworld = \"" ORTUNG_SOURCE_DIR "/maps/fields/arena.toml\"\n";
  folder.write("r.toml", "[robot]\nradius_m = 0.2\n[[sensor]]\nplugin = \"odometry\"\n");
  try {
    const Scene scene = Scene::read(folder.write("scene.toml", head + robots));
    PluginFactory factory(PluginFactory::standardFolders());
    SceneRun(scene, {}, factory);
  } catch (const std::exception& error) {
    return error.what();
  }
  return "";
}

std::string robotOfScene(const std::string& name, const std::string& more) {
  return "[[robot]]\nfile = \"r.toml\"\nname = \"" + name + "\"\n" + more + "\n";
}

TEST(SceneRun, RefusesWaypointsThatCanNotBeReached) {
  const std::string start = "start = { x_m = 0, y_m = 0, theta_deg = 0 }\n";
  EXPECT_EQ(refusalOfScene(robotOfScene("a", start + "waypoints_m = [0.5, 0, 0.5, 0.5]")), "");
  const std::string far =
      refusalOfScene(robotOfScene("a", start + "waypoints_m = [0.5, 0, 500, 0]"));
  EXPECT_TRUE(far.starts_with("robot a: waypoint 2 at (500.000000, 0.000000) has no room")) << far;
}

TEST(SceneRun, RefusesWaypointsBehindWalls) {
  const TemporaryFolder folder;
  const auto refusal = [&](const std::string& waypoints) -> std::string {
    SceneRobot robot;
    robot.file =
        folder.write("r.toml", "[robot]\nradius_m = 0.2\n[[sensor]]\nplugin = \"odometry\"\n");
    robot.name = "a";
    robot.start = Pose2{-2.0, 0.0, 0.0};
    Scene scene;
    scene.world = folder.write("w.toml",
                               "[world]\nx_m = [-5, 5]\ny_m = [-5, 5]\n[[rectangle]]\ncenter_m = "
                               "[0, 0]\nsize_m = [0.01, 6]\n");
    if (waypoints == "behind") robot.waypoints = {{2.0, 0.0}};
    if (waypoints == "around") robot.waypoints = {{-2.0, 4.0}, {2.0, 4.0}, {2.0, 0.0}};
    scene.robots.push_back(robot);
    PluginFactory factory(PluginFactory::standardFolders());
    try {
      SceneRun(scene, {}, factory);
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_NE(refusal("behind").find("waypoint 1 at (2.000000, 0.000000) can't be reached: going "
                                   "straight there, it is stopped at (-0."),
            std::string::npos)
      << refusal("behind");
  EXPECT_EQ(refusal("around"), "");
}

TEST(SceneFile, RefusesTwoRobotsOfOneName) {
  const std::string twice = refusalOfScene(robotOfScene("a", "") + robotOfScene("a", ""));
  EXPECT_NE(twice.find("scene.toml:9: name is given twice: a"), std::string::npos) << twice;
}

TEST(SceneRun, CommandsThatNobodyCanFollowAreRefusedBeforeTimeBegins) {
  const Kicker kicker;  // its files
  const auto refusal = [&](const SceneCommand& command) -> std::string {
    Scene scene;
    scene.world = kicker.worldFile;
    scene.robots.push_back(kicker.inScene(std::nullopt));
    scene.commands.push_back(command);
    PluginFactory factory(PluginFactory::standardFolders());
    try {
      const SceneRun run(scene, {}, factory);
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "";
  };
  SceneCommand command = Kicker::kickAt(3'000'000);
  EXPECT_EQ(refusal(command), "");
  command.state = "up";
  EXPECT_EQ(refusal(command),
            "robot one: its manipulator kicker has no state 'up'; it has rest, kick");
  command.manipulator = "arm";
  EXPECT_EQ(refusal(command), "robot one has no manipulator 'arm'; it has kicker");
  command.manipulator = "";
  command.vector = {1.0, 2.0, 3.0};
  const std::string vector = refusal(command);
  EXPECT_TRUE(
      vector.starts_with("robot one: the command at 3.000000 s has 3 numbers, expected 2: "))
      << vector;
  command.vector = {};
  command.robot = "two";
  EXPECT_EQ(refusal(command), "a command is for robot 'two', which is not there");
}

TEST(SceneRun, ANameThatIsTakenIsNoLackOfRoom) {
  const Kicker kicker;  // its files
  Scene scene;
  scene.world = kicker.worldFile;
  PluginFactory factory(PluginFactory::standardFolders());
  SceneRun run(scene, {}, factory);
  run.addRobot(readRobot(kicker.robotFile), factory, std::nullopt, 0);
  try {
    run.addRobot(readRobot(kicker.robotFile), factory, std::nullopt, 1);
    FAIL() << "two robots have one name";
  } catch (const std::invalid_argument& error) {
    EXPECT_STREQ(error.what(),
                 "robot kicker: another robot has this name, expected one of its own");
  }
}

std::string complaintOf(const std::string& toml) {
  const TemporaryFolder folder;
  try {
    Scene::read(folder.write("scene.toml", toml));
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "";
}

TEST(SceneFile, SaysWhatIsWrong) {
  const std::string head = "[scene]\nworld = \"w.toml\"\n";
  EXPECT_NE(complaintOf(head + "[[robot]]\nfile = \"r.toml\"\nname = \"a\"\nkidnap_s = [2, 2]\n")
                .find("kidnap_s must be rising times"),
            std::string::npos);
  EXPECT_NE(complaintOf(head).find("robot is missing"), std::string::npos) << complaintOf(head);
  const std::string robot = head + "[[robot]]\nfile = \"r.toml\"\nname = \"one\"\n";
  EXPECT_EQ(complaintOf(robot), "");
  for (const std::string bad :
       {"[[command]]\nat_s = -1\nrobot = \"one\"", "[[command]]\nat_s = 1",
        "[[command]]\nat_s = 1\nrobot = \"one\"\ntranslational_m_s = nan",
        "[[command]]\nat_s = 1\nrobot = \"one\"\nmanipulator = \"kicker\"",
        "[[thing]]\nname = \"ball\"", "[[comand]]\nat_s = 1", "[[robot]]\nfile = \"r.toml\"",
        "[[robot]]\nfile = \"r.toml\"\nname = \"a b\"",
        "[[robot]]\nfile = \"r.toml\"\nname = \"b\"\nwanders = true\nwaypoints_m = [1, 2]",
        "[[robot]]\nfile = \"r.toml\"\nname = \"b\"\nwaypoints_m = [1]"})
    EXPECT_NE(complaintOf(robot + bad).find("scene.toml"), std::string::npos) << bad;
}

}  // namespace
}  // namespace ortung::test

#include <gtest/gtest.h>

#include <cmath>

#include "WorldFiles.hpp"
#include "ortung/robot/RobotFile.hpp"
#include "ortung/sim/Simulation.hpp"

// Kicks, manipulators in time, and the world file's cycle.
namespace ortung::test {
namespace {

constexpr double kBallMass = 0.43;   // [kg]
constexpr double kRobotMass = 20.0;  // [kg]

/// A robot whose kicker reaches 0.25 m ahead, and a ball before it.
struct Pitch {
  explicit Pitch(const std::string& physics, const Pose2& ball)
      : simulation(
            readWorld(folder.write("world.toml",
                                   "[world]\nx_m = [-20, 20]\ny_m = [-20, 20]\n"
                                   "[physics]\n" +
                                       physics +
                                       "\n[[rectangle]]\ncenter_m = [19, 19]\nsize_m = [1, 1]\n"
                                       "[[ellipse]]\nkind = \"ball\"\n"
                                       "name = \"ball\"\ncenter_m = [9, 9]\n"
                                       "size_m = [0.22, 0.22]\n")),
            {.noise = false}),
        robot(simulation.addRobot(readRobot(folder.write("robot.toml", R"(
[robot]
name = "kicker"
radius_m = 0.2
mass_kg = 20
[[sensor]]
plugin = "odometry"
period_s = 0.015
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
size_m = [0.06, 0.3]
)")),
                                  factory, {})) {
    simulation.placeThing(0, ball);
  }
  const Twist& ball() const { return simulation.things()[0].velocity; }
  void kick() {
    robot.setManipulator("kicker", "kick");
    simulation.step();
  }

  TemporaryFolder folder;
  PluginFactory factory{PluginFactory::standardFolders()};
  Simulation simulation;
  SimRobot& robot;
};

TEST(Kick, IsFeltByTheRobot) {
  Pitch pitch("floor_friction = 0\nrolling_resistance = 0", {0.361, 0.0, 0.0});
  pitch.kick();
  EXPECT_NEAR(pitch.ball().x, 5.0, 1e-4);
  EXPECT_NEAR(kRobotMass * pitch.robot.state().velocity.x, -kBallMass * 5.0, 1e-3);
}

TEST(Kick, DoesNotSlowDownABall) {
  Pitch pitch("rolling_resistance = 0", {0.361, 0.0, 0.0});
  pitch.simulation.placeThing(0, {0.361, 0.0, 0.0}, {8.0, 0.0, 0.0});
  pitch.kick();
  EXPECT_NEAR(pitch.ball().x, 8.0, 1e-4);
  EXPECT_NEAR(pitch.robot.state().velocity.x, 0.0, 1e-6);
}

TEST(Kick, OfATurningRobotIsSeenFromIt) {
  for (const double turn : {-2.0, 2.0})
    for (const double aside : {-0.08, 0.08}) {
      Pitch pitch("rolling_resistance = 0", {5.0, 5.0, 0.0});
      pitch.robot.setRotationalVelocity(turn);
      for (int i = 0; i < 100; ++i) pitch.simulation.step();
      const RobotState state = pitch.robot.state();
      ASSERT_NEAR(state.velocity.theta, turn, 1e-3);
      const Pose2 place = state.pose * Pose2{0.361, aside, 0.0};
      pitch.simulation.placeThing(0, place);
      pitch.kick();
      // The point of the robot where the ball is moves with w x r; along the robot's x axis: -w y.
      const double along =
          pitch.ball().x * std::cos(state.pose.theta) + pitch.ball().y * std::sin(state.pose.theta);
      EXPECT_NEAR(along, 5.0 - turn * aside, 0.01) << turn << " " << aside;
    }
}

TEST(Manipulator, ReturnsInItsTime) {
  Pitch pitch("cycle_ms = 5", {5.0, 5.0, 0.0});
  pitch.kick();
  EXPECT_EQ(pitch.robot.manipulatorStates()[0], 1u);
  int cycles = 0;  // of 5 ms
  while (pitch.robot.manipulatorStates()[0] == 1u && cycles < 1000) {
    pitch.simulation.step();
    ++cycles;
  }
  EXPECT_NEAR(cycles * 0.005, 0.1, 0.0051);
}

TEST(Manipulator, WaitsForRoom) {
  Pitch pitch("cycle_ms = 10", {5.0, 5.0, 0.0});
  // A second robot stands where the kicker would be.
  const Pose2 other{0.42, 0.0, 0.0};
  RobotConfig config = readRobot(pitch.folder.path() / "robot.toml");
  config.name = "other";
  SimRobot& inTheWay = pitch.simulation.addRobot(config, pitch.factory, other);
  pitch.kick();
  for (int i = 0; i < 20; ++i) pitch.simulation.step();
  EXPECT_EQ(pitch.robot.manipulatorStates()[0], 0u);
  EXPECT_EQ(pitch.robot.state().pose.x, 0.0);
  EXPECT_EQ(inTheWay.state().pose.x, other.x);
  pitch.simulation.place(inTheWay, {2.0, 0.0, 0.0});
  pitch.simulation.step();
  EXPECT_EQ(pitch.robot.manipulatorStates()[0], 1u);
}

TEST(Cycle, IsTheWorldFilesUnlessSomebodySaysOtherwise) {
  EXPECT_EQ(Pitch("cycle_ms = 5", {5.0, 5.0, 0.0}).simulation.cycle(), 0.005);
  EXPECT_EQ(Pitch("", {5.0, 5.0, 0.0}).simulation.cycle(), 0.01);
  const TemporaryFolder folder;
  const auto file = folder.write(
      "w.toml", "[physics]\ncycle_ms = 5\n[[rectangle]]\ncenter_m = [0, 0]\nsize_m = [1, 1]\n");
  EXPECT_EQ(Simulation(readWorld(file), {.cycle = 0.02}).cycle(), 0.02);
}

TEST(Rhythm, IsKeptWhenAPeriodIsNoMultipleOfTheCycle) {
  Pitch pitch("", {5.0, 5.0, 0.0});  // odometry every 15 ms, in cycles of 10 ms
  int readings = 0;
  for (int i = 0; i < 300; ++i) {
    pitch.simulation.step();
    for (const Message& message : pitch.simulation.readings(0))
      readings += message.id.type == "groundTruth" ? 0 : 1;
  }
  EXPECT_NEAR(readings, 200, 1);
}

TEST(Robots, OfTooManyPiecesAreRefused) {
  Pitch pitch("", {5.0, 5.0, 0.0});
  const auto file = [&](const std::string& name, int ellipses) {
    std::string text = "[robot]\nname = \"" + name + "\"\n[[sensor]]\nplugin = \"odometry\"\n";
    for (int i = 0; i < ellipses; ++i)
      text +=
          "[[body]]\nshape = \"ellipse\"\ncenter_m = [0, 0]\nsize_m = [0.3, 0.2]\nangle_deg = " +
          std::to_string(i) + "\n";
    return readRobot(pitch.folder.write(name + ".toml", text));
  };
  const auto refusal = [&](const RobotConfig& config, double x) -> std::string {
    try {
      pitch.simulation.addRobot(config, pitch.factory, {x, 3.0, 0.0});
    } catch (const std::exception& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_NE(refusal(file("many", 17), 0.0)
                .find("136 pieces (an ellipse counts 8), expected at "
                      "most 128"),
            std::string::npos);
  for (int i = 0; i < 15; ++i) EXPECT_EQ(refusal(file("r" + std::to_string(i), 16), -10.0 + i), "");
  EXPECT_EQ(refusal(file("last", 16), 10.0),
            "robot last: with its 128 pieces all robots have 2050, expected at most 2048 (an "
            "ellipse counts 8)");
}

}  // namespace
}  // namespace ortung::test

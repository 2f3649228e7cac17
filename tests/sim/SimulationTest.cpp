#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <utility>

#include "FakeWorld.hpp"
#include "ortung/formats/OdometryData.hpp"
#include "ortung/formats/ScanData.hpp"
#include "ortung/robot/TomlFile.hpp"
#include "ortung/sim/PlayerControl.hpp"
#include "ortung/sim/Simulation.hpp"

namespace ortung {
namespace {

/// Bodies may overlap by this for a moment before the physics push them apart [m].
constexpr double kOverlap = 0.015;

constexpr const char* kRobot = R"(
  [robot]
  name = "tester"
  radius_m = 0.25
  [[sensor]]
  plugin = "odometry"
  period_s = 0.05
  [[sensor]]
  plugin = "lrf"
  beams = 19
  period_s = 0.1
)";

RobotConfig robotConfig(const char* toml = kRobot) {
  return readRobot(parseToml(toml, "robot.toml"));
}

RobotConfig named(const std::string& name) {
  RobotConfig config = robotConfig();
  config.name = name;
  return config;
}

std::unique_ptr<FakeWorld> field() {
  auto world = std::make_unique<FakeWorld>(18.0, 12.0);
  for (const double x : {-4.0, 0.0, 4.0})
    for (const double y : {-3.0, 3.0}) world->addPost({x, y, 0.4});
  return world;
}

/// A simulation of one robot that wanders about.
struct Wandering {
  explicit Wandering(const Simulation::Config& config, std::unique_ptr<FakeWorld> world = field())
      : factory(PluginFactory::standardFolders()),
        simulation(std::move(world), config),
        plans(simulation.world()),
        players(simulation, plans, factory, {}) {
    Random random = simulation.random(0);
    const RobotConfig its = robotConfig();
    robot = &simulation.addRobot(its, factory, plans.of(sizeOf(its))->randomPose(random));
    PlayerWish wish;
    wish.plugin = "wander";
    players.lead(*robot, wish, simulation.random(1));
  }
  void step() {
    simulation.sense();
    players.act({});
    simulation.move();
  }

  PluginFactory factory;
  Simulation simulation;
  FloorPlans plans;
  PlayerControl players;
  SimRobot* robot;
};

TEST(Simulation, GivesReadingsAtTheirPeriodsInOneFrameEach) {
  Wandering run({.cycle = 0.01, .seed = 1, .noise = true});
  int odometry = 0;
  int scans = 0;
  int truths = 0;
  for (int cycle = 0; cycle < 100; ++cycle) {
    const Timestamp now = run.simulation.now();
    run.step();
    for (const Message& message : run.simulation.readings(0)) {
      EXPECT_EQ(message.stamp, now);
      odometry += message.id.type == "odometry" ? 1 : 0;
      scans += message.id.type == "LRF" ? 1 : 0;
      truths += message.id.type == "groundTruth" ? 1 : 0;
    }
  }
  EXPECT_EQ(run.simulation.now(), 1'000'000);
  EXPECT_EQ(odometry, 20);
  EXPECT_EQ(scans, 10);
  EXPECT_EQ(truths, 20);
}

TEST(Simulation, MeasuresTheTruthWithoutNoise) {
  Wandering run({.cycle = 0.01, .seed = 3, .noise = false});
  const Pose2 start = run.robot->state().pose;
  for (int cycle = 0; cycle < 3000; ++cycle) {
    run.step();
    const Pose2 believed = start * run.robot->state().odometry;
    const Pose2& truth = run.robot->state().pose;
    ASSERT_LT(distance(believed, truth), 1e-9);
    ASSERT_LT(std::abs(wrapAngle(believed.theta - truth.theta)), 1e-9);
  }
  EXPECT_GT(distance(start, run.robot->state().pose), 0.5);
}

// Odometry of a base that rolls in every direction says how fast it goes sideways.
TEST(Simulation, OdometryTellsTheLateralVelocityOfAnOmnidirectionalBase) {
  PluginFactory factory(PluginFactory::standardFolders());
  Simulation simulation(field(), {.cycle = 0.01, .seed = 1, .noise = false});
  SimRobot& robot = simulation.addRobot(robotConfig(R"(
    [robot]
    radius_m = 0.25
    [drive]
    plugin = "omni"
    [[sensor]]
    plugin = "odometry"
    period_s = 0
  )"),
                                        factory, {-2, 0, 0});
  // Wheels at 60, 180 and 300 degrees, 0.2 m out: 1 m/s to the left while it turns by 0.5 rad/s.
  robot.drive().setCommand(std::array{0.5 + 0.1, -1.0 + 0.1, 0.5 + 0.1});
  for (int cycle = 0; cycle < 100; ++cycle) simulation.step();
  OdometryData odometry({"odometry", "odometry", "pose"});
  for (const Message& message : simulation.readings(0))
    if (message.id.type == "odometry") odometry.setData(message.stamp, message.words);
  EXPECT_NEAR(odometry.reading().lateralVelocity, 1.0, 0.001);
  EXPECT_NEAR(odometry.reading().translationalVelocity, 0.0, 0.001);
  EXPECT_NEAR(odometry.reading().rotationalVelocity, 0.5, 0.001);
  EXPECT_EQ(odometry.reading().motionData.size(), 3U);
  robot.drive().setCommand(std::array{0.0, 0.0, 0.0});
  for (int cycle = 0; cycle < 100; ++cycle) simulation.step();
  for (const Message& message : simulation.readings(0))
    if (message.id.type == "odometry") {
      EXPECT_EQ(message.words.size(), 8U) << "who stands says no more than ever";
    }
}

TEST(Simulation, DriftsWithNoise) {
  Wandering run({.cycle = 0.01, .seed = 3, .noise = true});
  const Pose2 start = run.robot->state().pose;
  for (int cycle = 0; cycle < 6000; ++cycle) run.step();
  const double error = distance(start * run.robot->state().odometry, run.robot->state().pose);
  EXPECT_GT(error, 0.005);
  EXPECT_LT(error, 5.0);
}

TEST(Simulation, NeverDrivesIntoAnything) {
  auto world = field();
  const FakeWorld& room = *world;
  PluginFactory factory(PluginFactory::standardFolders());
  Simulation simulation(std::move(world), {});
  SimRobot& robot = simulation.addRobot(robotConfig(), factory, {0.0, 0.0, 0.0});
  Random random(5);
  double farthest = 0.0;
  for (int cycle = 0; cycle < 20000; ++cycle) {
    if (cycle % 300 == 0) {  // blindly to and fro, into walls and posts
      robot.drive().setTranslationalVelocity(random.uniform(-1.0, 1.0));
      robot.drive().setRotationalVelocity(random.uniform(-0.7, 0.7));
    }
    simulation.step();
    const Pose2& pose = robot.state().pose;
    ASSERT_TRUE(room.isFree(pose.x, pose.y, {0.25 - kOverlap})) << cycle;
    farthest = std::max(farthest, std::hypot(pose.x, pose.y));
  }
  EXPECT_GT(farthest, 3.0);
}

TEST(Simulation, StopsAtAWallAndTurnsAway) {
  PluginFactory factory(PluginFactory::standardFolders());
  Simulation simulation(std::make_unique<FakeWorld>(4.0, 4.0), {});
  SimRobot& robot = simulation.addRobot(robotConfig(), factory, {0.0, 0.0, 0.0});
  robot.drive().setTranslationalVelocity(0.5);
  for (int cycle = 0; cycle < 600; ++cycle) simulation.step();
  EXPECT_LE(robot.state().pose.x, 1.75 + kOverlap);
  EXPECT_GT(robot.state().pose.x, 1.73);
  EXPECT_LT(std::abs(robot.state().translationalVelocity), 0.02);
  robot.drive().setTranslationalVelocity(0.0);
  robot.drive().setRotationalVelocity(1.0);
  for (int cycle = 0; cycle < 200; ++cycle) simulation.step();
  EXPECT_GT(robot.state().pose.theta, 1.0);
}

TEST(Simulation, KeepsRobotsApart) {
  PluginFactory factory(PluginFactory::standardFolders());
  Simulation simulation(std::make_unique<FakeWorld>(6.0, 4.0), {});
  SimRobot& one = simulation.addRobot(robotConfig(), factory, {-2.0, 0.0, 0.0});
  SimRobot& other = simulation.addRobot(named("other"), factory, {2.0, 0.1, 3.0});
  EXPECT_THROW(simulation.addRobot(named("third"), factory, {-1.8, 0.0, 0.0}),
               std::invalid_argument);
  one.drive().setTranslationalVelocity(0.5);
  other.drive().setTranslationalVelocity(0.5);
  for (int cycle = 0; cycle < 800; ++cycle) {
    simulation.step();
    ASSERT_GE(distance(one.state().pose, other.state().pose), 0.5 - kOverlap);
  }
  EXPECT_LT(distance(one.state().pose, other.state().pose), 0.6);
  // It sees the other's body, not its own from within.
  const auto scan = one.container().get<ScanData>(SensorQuery{.type = "LRF"});
  ASSERT_TRUE(scan);
  const float nearest = *std::min_element(scan->ranges.begin(), scan->ranges.end());
  EXPECT_GT(nearest, 0.1F);
  EXPECT_LT(nearest, 0.6F);
}

TEST(Simulation, GivesTheSameBitsForTheSameSeed) {
  const Simulation::Config config{.cycle = 0.01, .seed = 42, .noise = true};
  Wandering one(config);
  Wandering other(config);
  Wandering different({.cycle = 0.01, .seed = 43, .noise = true});
  bool differs = false;
  for (int cycle = 0; cycle < 3000; ++cycle) {
    one.step();
    other.step();
    different.step();
    const auto a = one.simulation.readings(0);
    const auto b = other.simulation.readings(0);
    ASSERT_TRUE(std::equal(a.begin(), a.end(), b.begin(), b.end())) << cycle;
    const auto c = different.simulation.readings(0);
    differs = differs || !std::equal(a.begin(), a.end(), c.begin(), c.end());
  }
  EXPECT_TRUE(differs);
}

TEST(Simulation, DrivesTheSameWayWithAndWithoutNoise) {
  Wandering noisy({.cycle = 0.01, .seed = 8, .noise = true});
  Wandering quiet({.cycle = 0.01, .seed = 8, .noise = false});
  for (int cycle = 0; cycle < 2000; ++cycle) {
    noisy.step();
    quiet.step();
  }
  EXPECT_EQ(distance(noisy.robot->state().pose, quiet.robot->state().pose), 0.0);
}

TEST(Simulation, RefusesCyclesOutOfRangeAndStartsInWalls) {
  EXPECT_THROW(Simulation(field(), {.cycle = 0.0}), std::invalid_argument);
  EXPECT_THROW(Simulation(field(), {.cycle = 0.9e-4}), std::invalid_argument);
  EXPECT_THROW(Simulation(field(), {.cycle = 2.0}), std::invalid_argument);
  EXPECT_EQ(Simulation(field(), {.cycle = 1e-4}).cycle(), 1e-4);  // both ends are within
  EXPECT_EQ(Simulation(field(), {.cycle = 1.0}).cycle(), 1.0);
  PluginFactory factory(PluginFactory::standardFolders());
  Simulation simulation(field(), {});
  EXPECT_THROW(simulation.addRobot(robotConfig(), factory, {8.9, 0.0, 0.0}), std::invalid_argument);
  EXPECT_THROW(simulation.addRobot(robotConfig(), factory, {0.0, std::nan(""), 0.0}),
               std::invalid_argument);
}

// So trying many places on a crowded field makes plugins but once.
TEST(Simulation, LooksForRoomBeforeItMakesPlugins) {
  PluginFactory factory(PluginFactory::standardFolders());
  Simulation simulation(field(), {});
  const RobotConfig config = robotConfig("[[sensor]]\nplugin = 'there is none'\n");
  EXPECT_THROW(simulation.addRobot(config, factory, {4.0, 3.0, 0.0}), NoRoom);  // in a post
  EXPECT_THROW(simulation.addRobot(config, factory, {2.0, 0.0, 0.0}), PluginError);
}

TEST(Simulation, CarriesARobotAwayUnnoticed) {
  Wandering run({.cycle = 0.01, .seed = 2, .noise = false});
  const Pose2 before = run.robot->state().odometry;
  run.simulation.place(*run.robot, {7.0, 5.0, 1.0});
  EXPECT_EQ(distance(run.robot->state().odometry, before), 0.0);
  EXPECT_EQ(run.robot->state().pose.x, 7.0);
  EXPECT_THROW(run.simulation.place(*run.robot, {4.0, 3.0, 0.0}), std::invalid_argument);
}

class WandererTest : public testing::TestWithParam<std::uint64_t> {};

TEST_P(WandererTest, CoversMostOfTheFieldInFiveMinutes) {
  Wandering run({.cycle = 0.01, .seed = GetParam(), .noise = true});
  std::set<std::pair<int, int>> visited;
  Pose2 last = run.robot->state().pose;
  double longestStay = 0.0;
  double stay = 0.0;
  for (int cycle = 0; cycle < 30000; ++cycle) {
    run.step();
    const Pose2& pose = run.robot->state().pose;
    visited.insert({static_cast<int>(std::floor(pose.x)), static_cast<int>(std::floor(pose.y))});
    stay += 0.01;
    if (distance(pose, last) < 0.1) continue;
    last = pose;
    longestStay = std::max(longestStay, stay);
    stay = 0.0;
  }
  std::set<std::pair<int, int>> reachable;  // squares of 1 m
  for (const std::uint32_t cell : run.plans.of({0.25})->cells())
    reachable.insert({static_cast<int>(std::floor(run.plans.of({0.25})->grid().centreX(cell))),
                      static_cast<int>(std::floor(run.plans.of({0.25})->grid().centreY(cell)))});
  EXPECT_GT(static_cast<double>(visited.size()), 0.6 * static_cast<double>(reachable.size()));
  EXPECT_LT(longestStay, 5.0);  // never stuck: it turns on the spot, but moves on
  RecordProperty("visited", static_cast<int>(100 * visited.size() / reachable.size()));
}

INSTANTIATE_TEST_SUITE_P(Seeds, WandererTest, testing::Values(1, 2, 3));

}  // namespace
}  // namespace ortung

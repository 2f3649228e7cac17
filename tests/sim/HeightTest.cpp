// What hangs high enough is in nobody's way: for the physics, for where robots may stand, and for
// what is learned alike.
#include <gtest/gtest.h>

#include <cmath>

#include "Paths.hpp"
#include "WorldFiles.hpp"
#include "ortung/robot/TomlFile.hpp"
#include "ortung/sim/RoutePlanner.hpp"
#include "ortung/sim/Simulation.hpp"

namespace ortung::test {
namespace {

// From left to right: a wall, a crossbar, a shelf, something below the floor, a lamp.
constexpr const char* kWorld = R"(
[world]
x_m = [-5, 5]
y_m = [-2, 2]
[[rectangle]]
center_m = [-4, 0]
size_m = [0.5, 3]
z_m = [0, 0.4]
[[rectangle]]
center_m = [-2, 0]
size_m = [0.2, 3]
z_m = [1, 1.125]
[[triangle]]
corners_m = [-0.5, -1.5, 0.5, -1.5, 0, 1.5]
z_m = [0.5, 0.6]
[[rectangle]]
center_m = [2, 0]
size_m = [0.5, 3]
z_m = [-1, 0]
[[ellipse]]
center_m = [4, 0]
size_m = [0.5, 3]
z_m = [0.25, 3]
)";

RobotConfig robotOf(const RobotSize& size) {
  return readRobot(parseToml("[robot]\nradius_m = " + std::to_string(size.radius) +
                                 "\n[[sensor]]\nplugin = \"odometry\"\n[drive]\nbody_height_m = " +
                                 std::to_string(size.height) + "\n",
                             "robot.toml"));
}

TEST(Height, DecidesWhatIsInTheWay) {
  const auto world = worldOf(kWorld);
  const auto fits = [&](double x, double height) {
    const FieldRegion region = world->region(0.1, {0.2, height});
    const bool isFree = world->isFree(x, 0.0, {0.2, height});
    EXPECT_EQ(region.standable[static_cast<std::size_t>(region.grid.cellAt(x, 0.0))] != 0, isFree);
    EXPECT_EQ(region.open[static_cast<std::size_t>(region.grid.cellAt(x, 0.0))] != 0, isFree);
    return isFree;
  };
  EXPECT_FALSE(fits(-4.0, 0.2));
  EXPECT_TRUE(fits(-2.0, 0.8));
  EXPECT_TRUE(fits(-2.0, 1.0)) << "it just fits under it";
  EXPECT_FALSE(fits(-2.0, 1.01));
  EXPECT_FALSE(fits(-2.0, 1.9));
  EXPECT_TRUE(fits(0.0, 0.5));
  EXPECT_FALSE(fits(0.0, 0.7)) << "also what is lower than the robot's top is in its way";
  EXPECT_TRUE(fits(2.0, 1.9)) << "the floor";
  EXPECT_TRUE(fits(4.0, 0.2));
  EXPECT_FALSE(fits(4.0, 0.3));
}

// The physics' own collision code is the other method.
TEST(Height, MeansTheSameToThePhysics) {
  Simulation simulation(worldOf(kWorld), {});
  PluginFactory factory(PluginFactory::standardFolders());
  Random random(7);
  int refused = 0;
  int compared = 0;
  for (int i = 0; i < 600; ++i) {
    const RobotSize size{random.uniform(0.1, 0.4), random.uniform(0.1, 1.5)};
    const Pose2 pose{random.uniform(-4.5, 4.5), random.uniform(-1.9, 1.9), 0.0};
    const bool isFree = simulation.world().isFree(pose.x, pose.y, size);
    // Circles have corners there: places that hang on 3 cm are left out.
    const auto isFreeWith = [&](double more) {
      return simulation.world().isFree(pose.x, pose.y, {size.radius + more, size.height});
    };
    if (isFreeWith(0.03) != isFreeWith(-0.03)) continue;
    bool isTaken = true;
    try {
      simulation.removeRobot(simulation.addRobot(robotOf(size), factory, pose));
    } catch (const std::invalid_argument&) {
      isTaken = false;
    }
    ASSERT_EQ(isTaken, isFree) << pose.x << " " << pose.y << " " << size.radius << " "
                               << size.height;
    refused += isFree ? 0 : 1;
    ++compared;
  }
  EXPECT_GT(refused, 50);
  EXPECT_GT(compared, 400);
}

TEST(Height, OfARobotIsThatOfItsHighestPart) {
  EXPECT_EQ(sizeOf(robotOf({0.25, 0.75})), (RobotSize{0.25, 0.75}));
  const RobotConfig config = readRobot(parseToml(R"(
[robot]
radius_m = 0.3
[[sensor]]
plugin = "odometry"
[[body]]
center_m = [0, 0]
size_m = [0.4, 0.4]
z_m = [0.1, 0.3]
[[manipulator]]
name = "arm"
[[manipulator.state]]
name = "down"
[[manipulator.state]]
name = "up"
[[manipulator.state.body]]
center_m = [0.2, 0]
size_m = [0.1, 0.1]
z_m = [0.3, 0.9]
)",
                                                 "robot.toml"));
  EXPECT_EQ(sizeOf(config), (RobotSize{0.3, 0.9}));
}

TEST(Height, RobotsOfTheLeagueGetUnderTheCrossbarsAndBallsRollThere) {
  const std::string msl = ORTUNG_SOURCE_DIR "/maps/fields/msl.toml";
  const RobotSize robot =
      sizeOf(readRobot(std::filesystem::path(ORTUNG_SOURCE_DIR "/maps/robots/msl_omni.toml")));
  const auto world = readWorld(msl);
  const RoutePlanner planner(*world, robot);
  EXPECT_TRUE(planner.contains(0.0, 0.0));
  EXPECT_TRUE(planner.contains(11.05, 0.0)) << "the way into the goal";
  EXPECT_FALSE(RoutePlanner(*world, {robot.radius, 1.05}).contains(11.05, 0.0));
  Simulation simulation(readWorld(msl), {});
  PluginFactory factory(PluginFactory::standardFolders());
  EXPECT_NO_THROW(simulation.addRobot(robotOf(robot), factory, {11.0, 0.0, 0.0}));
  for (std::size_t i = 0; i < simulation.things().size(); ++i) {
    if (simulation.things()[i].kind != "ball") continue;
    EXPECT_NO_THROW(simulation.placeThing(i, {-11.0, 0.5, 0.0})) << "on the goal line";
  }
  EXPECT_GE(simulation.things().size(), 1u);
}

}  // namespace
}  // namespace ortung::test

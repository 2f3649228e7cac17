#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "FakeWorld.hpp"
#include "Paths.hpp"
#include "WorldFiles.hpp"
#include "ortung/formats/ScanData.hpp"
#include "ortung/robot/TomlFile.hpp"
#include "ortung/sim/Learner.hpp"

namespace ortung {
namespace {

using test::worldOf;

constexpr double kDegree = std::numbers::pi / 180.0;  // [rad]

/// A robot's container and everything that learning needs.
struct Learned {
  Learned(const FakeWorld& world, const std::string& toml, const LearnOptions& options = {})
      : factory({ORTUNG_PLUGINS_DIR, TEST_PLUGINS}),
        robot(readRobot(parseToml(toml, "robot.toml"))) {
    region = world.region(options.cell, {robot.radius});
    devices = fillContainer(container, robot, factory);
    Learner learner(world, region, devices, {}, factory, options);
    do shares.push_back(learner.share());
    while (learner.step());
    shares.push_back(learner.share());
  }

  const SensorData& find(std::string_view feature) const {
    return *container.find(SensorQuery{.feature = feature});
  }

  PluginFactory factory;
  RobotConfig robot;
  FieldRegion region;
  SensorContainer container;
  std::vector<Device> devices;
  std::vector<double> shares;
};

/// The pose of the robot that brings its sensor to @p sensor.
Pose2 robotFor(const Pose2& sensor, const SensorData& data) {
  return sensor * inverse(data.mount());
}

FakeWorld makeRoom() {
  FakeWorld room(6.0, 4.0);
  room.addPost({1.03, 0.52, 0.1});
  room.addLandmark({1, "post", 1.03, 0.52, 0.5});
  room.addLandmark({2, "post", -2.5, 1.5, 0.5});
  return room;
}

TEST(Learner, LearnsWhatAScanSeesFromEveryCell) {
  const FakeWorld room(6.0, 4.0);
  const Learned learned(room, R"([[sensor]]
    plugin = "lrf"
    sigma_m = 0.02
    sigma_per_m = 0.0
    pose = { x_m = 0.15, y_m = -0.05, theta_deg = 20 })");
  const SensorData& scan = learned.find("180DegreeScan");
  ASSERT_TRUE(scan.isLearned());
  for (const Pose2& sensor :
       {Pose2{0.05, 0.05, 0.0}, Pose2{-2.35, 1.25, 2.0}, Pose2{1.85, -1.5, -1.3}}) {
    const std::vector<double> expected = scan.expectation(robotFor(sensor, scan));
    ASSERT_EQ(expected.size(), 180u);
    for (std::size_t i = 0; i < 180; ++i) {
      const double angle =
          sensor.theta + (-90.0 + static_cast<double>(i) * 180.0 / 179.0) * kDegree;
      // The table has one direction in 2 degrees, so what it says lies between the ranges there,
      // also between its cells (the last pose is). Half a level is 1.6 cm (8 m in 254 levels), and
      // the corners of a room are cut by as much.
      constexpr double kOff = 0.03;
      double low = 1e9;
      double high = 0.0;
      for (double offset = -2.01; offset <= 2.01; offset += 0.1) {
        const double range = room.range(sensor.x, sensor.y, angle + offset * kDegree);
        low = std::min(low, range);
        high = std::max(high, range);
      }
      EXPECT_GE(expected[i], low - kOff) << "beam " << i;
      EXPECT_LE(expected[i], high + kOff) << "beam " << i;
    }
  }
}

TEST(Learner, FillsEveryDirectionFromSparseBeams) {
  const FakeWorld room(6.0, 4.0);
  for (const char* beams : {"beams = 16\nfov_deg = 180", "beams = 20\nfov_deg = 360", "beams = 1",
                            "beams = 7\nangle_step_deg = 0.5", "beams = 682\nfov_deg = 240"}) {
    const Learned learned(room,
                          std::string("[[sensor]]\nplugin = 'lrf'\nfeature = 'scan'\n"
                                      "sigma_m = 0.02\nsigma_per_m = 0.0\n") +
                              beams,
                          {.cell = 0.2});
    const SensorData& scan = learned.find("scan");
    // Straight at the walls from the middle of a cell, whatever the beams: beam 0 of each heading.
    const double first = dynamic_cast<const ScanData&>(scan).config().firstAngle;
    for (int degrees = 0; degrees < 360; degrees += 2) {
      const double angle = degrees * kDegree;
      const std::vector<double> expected = scan.expectation({0.1, 0.1, angle - first});
      ASSERT_FALSE(expected.empty()) << beams;
      const auto between =
          std::minmax({room.range(0.1, 0.1, angle - 1.01 * kDegree), room.range(0.1, 0.1, angle),
                       room.range(0.1, 0.1, angle + 1.01 * kDegree)});
      EXPECT_GE(expected[0], between.first - 0.025) << beams << " at " << degrees;
      EXPECT_LE(expected[0], between.second + 0.025) << beams << " at " << degrees;
    }
  }
}

/// A feature that is made of another learns what is made of that one, everywhere.
TEST(Learner, LearnsWhatIsMadeOfOtherFeatures) {
  const FakeWorld room = makeRoom();
  const Learned learned(room, R"(
    [[sensor]]
    plugin = "twice"
    [[sensor]]
    plugin = "landmarks"
    identities = [1, 2]
    occlusion = false)");
  const SensorData& distance = learned.find("post1Distance");
  const SensorData& twice = learned.find("twice");
  int learnedCells = 0;
  for (std::size_t cell = 0; cell < learned.region.grid.size(); ++cell) {
    const Pose2 pose{learned.region.grid.centreX(cell), learned.region.grid.centreY(cell), 0.3};
    const double expected = 2.0 * distance.expectation(pose)[0];
    if (std::isnan(expected)) {
      EXPECT_TRUE(std::isnan(twice.expectation(pose)[0]));
      continue;
    }
    EXPECT_NEAR(twice.expectation(pose)[0], expected, 0.003);  // millimetres, twice rounded
    ++learnedCells;
  }
  EXPECT_GT(learnedCells, 2000);
}

TEST(Learner, LearnsDistancesAndBearingsOfPosts) {
  const FakeWorld room = makeRoom();
  const Learned learned(room, R"([[sensor]]
    plugin = "landmarks"
    identities = [1, 2]
    occlusion = false
    pose = { x_m = 0.3, y_m = 0.1, theta_deg = -45 })");
  const SensorData& distance = learned.find("post2Distance");
  const SensorData& bearing = learned.find("post2Bearing");
  Random random(1);
  for (int i = 0; i < 200; ++i) {
    const Pose2 sensor{random.uniform(-1.5, 2.9), random.uniform(-1.9, 1.0),
                       random.uniform(-3.0, 3.0)};
    const std::ptrdiff_t cell = learned.region.grid.cellAt(sensor.x, sensor.y);
    if (learned.region.open[static_cast<std::size_t>(cell)] == 0) continue;  // within post 1
    const double range = std::hypot(-2.5 - sensor.x, 1.5 - sensor.y);
    // The centre of the cell is at most half a diagonal away, 0.071 m.
    EXPECT_NEAR(distance.expectation(robotFor(sensor, distance)).at(0), range, 0.073);
    const double direction = std::atan2(1.5 - sensor.y, -2.5 - sensor.x) - sensor.theta;
    const double error = bearing.expectation(robotFor(sensor, bearing)).at(0) - direction;
    EXPECT_NEAR(std::remainder(error, 2.0 * std::numbers::pi), 0.0, 0.073 / range);
  }
}

TEST(Learner, LearnsNothingOfAPostThatIsHidden) {
  const FakeWorld room = makeRoom();
  const Learned learned(room, R"([[sensor]]
    plugin = "landmarks"
    identities = [2])");
  const SensorData& distance = learned.find("post2Distance");
  // Straight behind post 1 as seen from post 2.
  const double direction = std::atan2(0.52 - 1.5, 1.03 + 2.5);
  const Pose2 behind{1.03 + 0.5 * std::cos(direction), 0.52 + 0.5 * std::sin(direction), 0.0};
  EXPECT_TRUE(std::isnan(distance.expectation(behind).at(0)));
  EXPECT_FALSE(std::isnan(distance.expectation({1.0, -1.0, 0.0}).at(0)));
}

TEST(Learner, SeesAllAroundWithASensorThatLooksOneWay) {
  const FakeWorld room = makeRoom();
  const Learned learned(room, R"([[sensor]]
    plugin = "landmarks"
    identities = [2]
    occlusion = false
    fov_deg = 70)");
  const SensorData& distance = learned.find("post2Distance");
  for (const std::size_t cell : {std::size_t{100}, std::size_t{1000}, std::size_t{2300}}) {
    const double x = learned.region.grid.centreX(cell);
    const double y = learned.region.grid.centreY(cell);
    EXPECT_NEAR(distance.expectation({x, y, 0.0}).at(0), std::hypot(-2.5 - x, 1.5 - y), 0.002);
  }
}

TEST(Learner, LearnsEverySonarOfARing) {
  const FakeWorld room(6.0, 4.0);
  LearnOptions options;
  options.headingStep = 5.0 * kDegree;
  const Learned learned(room, R"([[sensor]]
    plugin = "sonar"
    angles_deg = [0, 90, 215]
    max_range_m = 3
    sigma_m = 0.02
    sigma_per_m = 0.0)",
                        options);
  for (const char* feature : {"sonar0", "sonar1", "sonar2"}) {
    const SensorData& sonar = learned.find(feature);
    ASSERT_TRUE(sonar.isLearned());
    // 1.05 m before the wall, facing it; far from any; quantized to half a level, 6 mm.
    EXPECT_NEAR(sonar.expectation(robotFor({1.95, 0.05, 0.0}, sonar)).at(0), 1.05, 0.008);
    EXPECT_NEAR(sonar.expectation(robotFor({0.05, 0.95, 90 * kDegree}, sonar)).at(0), 1.05, 0.008);
    EXPECT_EQ(sonar.expectation(robotFor({0.05, 0.05, 180 * kDegree}, sonar)).at(0), 3.0);
  }
}

TEST(Learner, GivesTheTruePoseTheBestProbability) {
  const FakeWorld room = makeRoom();
  Learned learned(room, R"([[sensor]]
    plugin = "lrf"
    pose = { x_m = 0.2 }
    [[sensor]]
    plugin = "landmarks"
    identities = [1, 2])");
  const Pose2 truth{-0.85, -0.35, 40 * kDegree};
  RobotState state;
  state.pose = truth;
  for (const Device& device : learned.devices)
    learned.factory.make<Sensor>(device.config->plugin, device.config->parameters)
        ->generateData(room, state, nullptr, 1, device.data);
  const double best = learned.container.getProbability(truth);
  EXPECT_GT(best, 0.0);
  for (const Pose2& error :
       {Pose2{0.5, 0, 0}, Pose2{0, -0.5, 0}, Pose2{0, 0, 0.4}, Pose2{-0.3, 0.3, 0.2}})
    EXPECT_GT(best, 3.0 * learned.container.getProbability(truth * error));
}

/// A hall that is an L with walls of 0.1 m, in a world of 8 x 6 m: the arms are 2 m wide, what is
/// beside them is larger than they are. In the hall stands a closed box of 1 x 1 m.
constexpr const char* kLShape = R"(
[world]
x_m = [0, 8]
y_m = [0, 6]
[[rectangle]]
center_m = [4, 0.05]
size_m = [8, 0.1]
[[rectangle]]
center_m = [0.05, 3]
size_m = [0.1, 6]
[[rectangle]]
center_m = [1, 5.95]
size_m = [2, 0.1]
[[rectangle]]
center_m = [2.05, 4]
size_m = [0.1, 4]
[[rectangle]]
center_m = [5, 2.05]
size_m = [6, 0.1]
[[rectangle]]
center_m = [7.95, 1]
size_m = [0.1, 2.2]
)";

bool canStand(const FieldRegion& region, double x, double y) {
  return region.standable[static_cast<std::size_t>(region.grid.cellAt(x, y))] != 0;
}

TEST(LearnArea, IsTheInsideOfAnL) {
  const auto world = worldOf(kLShape);
  const RobotSize robot{0.2, 0.4};
  const LearnArea area = learnArea(*world, 0.1, robot);
  EXPECT_TRUE(canStand(area.region, 1.0, 5.0));
  EXPECT_TRUE(canStand(area.region, 7.0, 1.0));
  EXPECT_FALSE(canStand(area.region, 5.0, 4.0)) << "outside";
  // Outside: 5.9 x 3.9 m less the robot's radius along the walls and the world's bounds.
  EXPECT_NEAR(area.leftOut, 5.5 * 3.5, 1.0);
  EXPECT_EQ(area.region.open, world->region(0.1, robot).open);
  const LearnArea outside = learnArea(*world, 0.1, robot, {{5.0, 4.0}});
  EXPECT_TRUE(canStand(outside.region, 5.0, 4.0));
  EXPECT_FALSE(canStand(outside.region, 1.0, 5.0));
  EXPECT_THROW(learnArea(*world, 0.1, robot, {{2.05, 4.0}}), std::invalid_argument) << "a wall";
  EXPECT_THROW(learnArea(*world, 0.1, robot, {{99.0, 4.0}}), std::invalid_argument);
}

TEST(LearnArea, LeavesClosedRoomsOutAndKeepsThoseWithATightDoor) {
  const std::string walls = R"(
[world]
x_m = [0, 6]
y_m = [0, 4]
[[rectangle]]
center_m = [3, 3]
size_m = [0.02, 2]
[[rectangle]]
center_m = [5, 1.99]
size_m = [4, 0.02]
[[rectangle]]
center_m = [3, 0.7]
size_m = [0.02, 1.4]
)";
  const RobotSize robot{0.3, 0.4};
  const LearnArea closed = learnArea(*worldOf(walls + R"([[rectangle]]
center_m = [3, 1.7]
size_m = [0.02, 0.7]
)"),
                                     0.1, robot);
  EXPECT_TRUE(canStand(closed.region, 1.0, 2.0));
  EXPECT_FALSE(canStand(closed.region, 5.0, 3.0)) << "walls of 2 cm are no leak";
  EXPECT_FALSE(canStand(closed.region, 5.0, 1.0));
  EXPECT_GT(closed.leftOut, 4.0);
  // A door of 0.4 m: too narrow for the robot of 0.6 m, as far as cells of 0.1 m can tell.
  const LearnArea tight = learnArea(*worldOf(walls), 0.1, robot);
  EXPECT_TRUE(canStand(tight.region, 5.0, 1.0));
  EXPECT_FALSE(canStand(tight.region, 5.0, 3.0));
}

TEST(LearnArea, IsAllOfAFieldWithoutWalls) {
  const auto world = worldOf(R"([world]
x_m = [-4, 4]
y_m = [-2, 2]
[[rectangle]]
center_m = [0, 0]
size_m = [1, 1]
)");
  const LearnArea area = learnArea(*world, 0.1, {0.2, 0.4});
  EXPECT_EQ(area.leftOut, 0.0);
  EXPECT_EQ(area.region.standable, world->region(0.1, {0.2, 0.4}).standable);
}

TEST(Learner, TellsHowFarItIs) {
  const FakeWorld room(2.0, 2.0);
  const Learned learned(room, "[[sensor]]\nplugin = 'lrf'");
  ASSERT_GE(learned.shares.size(), 5u);
  EXPECT_TRUE(std::is_sorted(learned.shares.begin(), learned.shares.end()));
  EXPECT_EQ(learned.shares.back(), 1.0);
}

TEST(Learner, TellsHowManyHeadingsEachFeatureNeeds) {
  const FakeWorld room(2.0, 2.0);
  PluginFactory factory({ORTUNG_PLUGINS_DIR});
  const RobotConfig robot = readRobot(
      parseToml("[[sensor]]\nplugin = 'lrf'\nfov_deg = 180\n[[sensor]]\nplugin = 'sonar'\n"
                "[[sensor]]\nplugin = 'landmarks'\nkind = 'post'\nfeatures = 'list'\n",
                "robot.toml"));
  SensorContainer container;
  const std::vector<Device> devices = fillContainer(container, robot, factory);
  const FieldRegion region = room.region(0.1, {0.25});
  const Learner learner(room, region, devices, {}, factory, {0.1, 2.0 * kDegree});
  std::map<std::string, std::size_t> headings;
  for (const Learner::Need& need : learner.needs()) headings[need.feature.type] = need.headings;
  EXPECT_EQ(headings["LRF"], 3u);           // two views of 180 degrees don't quite meet
  EXPECT_EQ(headings["ultrasonic"], 180u);  // one an entry of its table
  EXPECT_EQ(headings["camera"], 1u);        // it sees all around
}

TEST(Learner, RefusesAHeadingStepThatDoesNotDivideATurn) {
  const FakeWorld room(2.0, 2.0);
  LearnOptions options;
  options.headingStep = 7.0 * kDegree;
  try {
    const Learned learned(room, "[[sensor]]\nplugin = 'lrf'", options);
    FAIL() << "7 degrees were accepted";
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("7.0"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace ortung

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <map>
#include <string>
#include <vector>

#include "Paths.hpp"
#include "WorldFiles.hpp"
#include "ortung/base/Angles.hpp"
#include "ortung/formats/Words.hpp"
#include "ortung/robot/RobotFile.hpp"
#include "ortung/robot/TomlFile.hpp"
#include "ortung/sim/Simulation.hpp"

// Readings that are generated when somebody asks for them are those of a run in which each was
// generated when it was due, and what nobody asks for is not generated.
namespace ortung::test {
namespace {

constexpr const char* kRobot = R"(
[robot]
name = "one"
radius_m = 0.2
mass_kg = 20
[drive]
odometry_distance_sigma_m = 0.02
[[sensor]]
plugin = "odometry"
period_s = 0.03
[[sensor]]
plugin = "lrf"
beams = 24
fov_deg = 360
max_range_m = 6
noise_sigma_m = 0.03
period_s = 0.1
[[sensor]]
plugin = "compass"
noise_sigma_deg = 8
period_s = 0.01
[[manipulator]]
name = "arm"
[[manipulator.state]]
name = "in"
[[manipulator.state]]
name = "out"
[[manipulator.state.body]]
center_m = [0.3, 0]
size_m = [0.2, 0.3]
)";

constexpr const char* kWorld =
    "[world]\nx_m = [-4, 4]\ny_m = [-3, 3]\n"
    "[[rectangle]]\nkind = \"wall\"\ncenter_m = [0, 3.1]\nsize_m = [8, 0.2]\n"
    "[[ellipse]]\nkind = \"ball\"\nname = \"ball\"\ncenter_m = [1, 1]\nsize_m = [0.22, 0.22]\n";

/// Three robots that drive about a ball, and are kidnapped, and move their arms.
class Drill {
 public:
  explicit Drill(bool sensesWhenRead)
      : simulation_(readWorld(folder_.write("world.toml", kWorld)),
                    {.seed = 9, .threads = 2, .sensesWhenRead = sensesWhenRead}) {
    RobotConfig config = readRobot(parseToml(kRobot, "drill"));
    for (int i = 0; i < 3; ++i) {
      config.name = "robot" + std::to_string(i);
      SimRobot& robot = simulation_.addRobot(config, factory_, {-2.0 + 2.0 * i, -1.0, 0.7 * i});
      robot.drive().setTranslationalVelocity(0.5);
      robot.drive().setRotationalVelocity(0.4);
    }
  }
  /// Senses, and then moves, as callers do who read in between.
  void sense() {
    const Timestamp cycle = simulation_.now() / 10'000;
    if (cycle == 33) simulation_.place(robot(1), {2.5, 2.0, -1.0});
    if (cycle == 47) simulation_.placeThing(0, {-3.0, 2.0, 0.0}, {1.0, -0.5, 0.0});
    simulation_.sense();
    if (cycle % 20 == 4) robot(0).setManipulator("arm", cycle % 40 == 4 ? "out" : "in");
  }
  void move() { simulation_.move(); }
  void step() { sense(), move(); }
  Simulation& simulation() { return simulation_; }
  SimRobot& robot(std::size_t i) { return *simulation_.robots()[i]; }
  /// What the containers have: time and words of each feature.
  std::vector<std::pair<Timestamp, std::vector<std::uint32_t>>> inContainers() {
    std::vector<std::pair<Timestamp, std::vector<std::uint32_t>>> all;
    for (std::size_t i = 0; i < 3; ++i)
      for (const auto& data : robot(i).container().all())
        all.emplace_back(data->stamp(), std::vector<std::uint32_t>(data->getData().begin(),
                                                                   data->getData().end()));
    return all;
  }

 private:
  TemporaryFolder folder_;
  PluginFactory factory_{PluginFactory::standardFolders()};
  Simulation simulation_;
};

std::map<std::string, std::vector<std::uint32_t>> wordsOf(std::span<const Message> readings) {
  std::map<std::string, std::vector<std::uint32_t>> words;
  for (const Message& one : readings) {
    words[one.id.type] = one.words;
    words[one.id.type].push_back(static_cast<std::uint32_t>(one.stamp));
  }
  return words;
}

TEST(LateReadings, AreThoseOfARunThatReadsAll) {
  Drill eager(true);
  for (std::size_t i = 0; i < 3; ++i) eager.robot(i).container();
  int done = 0;
  // Before and after kidnappings, moved arms, and between the moments at which scanners are due.
  for (const int cycles : {1, 5, 13, 34, 36, 48, 60, 99}) {
    for (; done < cycles; ++done) eager.step();
    Drill late(true);
    for (int i = 0; i < cycles; ++i) late.step();
    EXPECT_EQ(late.inContainers(), eager.inContainers()) << cycles;
    late.step();  // and they go on
    Drill early(true);
    for (std::size_t i = 0; i < 3; ++i) early.robot(i).container();
    for (int i = 0; i <= cycles; ++i) early.step();
    EXPECT_EQ(late.inContainers(), early.inContainers()) << cycles;
  }
}

TEST(LateReadings, OfACycleAreThoseOfThatCycle) {
  Drill eager(true);
  for (std::size_t i = 0; i < 3; ++i) eager.robot(i).container();
  Drill late(true);
  std::size_t compared = 0;
  for (int i = 0; i < 120; ++i) {
    eager.sense(), late.sense();
    // Some at once, some after everything has moved, some never.
    const auto compare = [&](std::size_t robot) {
      const auto words = wordsOf(late.simulation().readings(robot));
      EXPECT_EQ(words, wordsOf(eager.simulation().readings(robot))) << i << " " << robot;
      compared += words.size();
    };
    if (i % 3 == 0) compare(0);
    eager.move(), late.move();
    if (i % 5 == 0) compare(1), compare(0);
    EXPECT_EQ(late.robot(2).state().pose.x, eager.robot(2).state().pose.x);
    EXPECT_EQ(late.robot(0).state().odometry.y, eager.robot(0).state().odometry.y);
  }
  EXPECT_GT(compared, 100u);
}

TEST(LateReadings, HaveNoiseOfTheSameKindAsAlways) {
  // The compass of a robot that stands has a mean error of 0 and a deviation of 8 degrees.
  Drill late(true);
  late.robot(2).drive().setTranslationalVelocity(0.0);
  late.robot(2).drive().setRotationalVelocity(0.0);
  for (int i = 0; i < 100; ++i) late.step();
  double sum = 0.0, squares = 0.0;
  constexpr int kReadings = 2000;
  for (int i = 0; i < kReadings; ++i) {
    late.step();
    const auto north = wordsOf(late.simulation().readings(2)).at("compass");
    const double error =
        degrees(wrapAngle(words::toAngle(north[0]) + late.robot(2).state().pose.theta));
    sum += error, squares += error * error;
  }
  const double mean = sum / kReadings;
  EXPECT_NEAR(std::sqrt(squares / kReadings - mean * mean), 8.0, 0.5);
}

// The thrower's sensor throws when it is called for the fourth time.
TEST(LateReadings, OfASensorThatNobodyReadsAreNotGenerated) {
  setenv("ORTUNG_PLUGIN_PATH", ORTUNG_PLUGINS_DIR ":" TEST_PLUGINS, 1);
  TemporaryFolder folder;
  PluginFactory factory(PluginFactory::standardFolders());
  Simulation simulation(readWorld(folder.write("world.toml", kWorld)), {.sensesWhenRead = true});
  SimRobot& robot = simulation.addRobot(
      readRobot(parseToml("[robot]\nname = \"poor\"\nradius_m = 0.2\n[[sensor]]\n"
                          "plugin = \"thrower\"\nafter = 3\n",
                          "robot")),
      factory, {-2.0, -1.0, 0.0});
  for (int i = 0; i < 100; ++i) simulation.step();
  EXPECT_TRUE(robot.problems().empty());
  for (int i = 0; i < 10; ++i) EXPECT_EQ(simulation.readings(0).size(), 2u);  // and the truth
  simulation.step();
  EXPECT_EQ(simulation.readings(0).size(), 2u);
  simulation.step();
  EXPECT_EQ(simulation.readings(0).size(), 2u);
  for (int i = 0; i < 100; ++i) simulation.step();
  EXPECT_TRUE(robot.problems().empty());
  simulation.readings(0);
  EXPECT_EQ(robot.problems().size(), 1u);
}

}  // namespace
}  // namespace ortung::test

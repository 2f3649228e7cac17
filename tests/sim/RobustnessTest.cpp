#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <functional>
#include <limits>

#include "Paths.hpp"
#include "WorldFiles.hpp"
#include "ortung/robot/TomlFile.hpp"
#include "ortung/sim/Simulation.hpp"

namespace ortung::test {
namespace {

constexpr const char* kRobot = R"(
[robot]
name = "tester"
radius_m = 0.2
[[sensor]]
plugin = "odometry"
period_s = 0.02
[[sensor]]
plugin = "lrf"
beams = 19
period_s = 0.05
)";

constexpr const char* kWorld = R"(
[world]
x_m = [-6, 6]
y_m = [-4, 4]
[[rectangle]]
kind = "obstacle"
center_m = [2, 1]
size_m = [0.5, 0.5]
[[ellipse]]
kind = "ball"
name = "ball"
center_m = [0, 0]
size_m = [0.22, 0.22]
z_m = [0, 0.22]
[[rectangle]]
name = "crate"
movable = true
mass_kg = 3
center_m = [-2, 1]
size_m = [0.4, 0.3]
)";

RobotConfig named(const std::string& name, const std::string& more = "") {
  RobotConfig config = readRobot(parseToml(kRobot + more, "robot.toml"));
  config.name = name;
  return config;
}

std::string complaint(const std::function<void()>& what) {
  try {
    what();
  } catch (const std::exception& error) {
    return error.what();
  }
  return "";
}

void expectIn(const std::string& text, const std::vector<std::string>& parts) {
  for (const std::string& part : parts) EXPECT_NE(text.find(part), std::string::npos) << text;
}

struct Field {
  explicit Field(const Simulation::Config& config = {}) : simulation(worldOf(kWorld), config) {}
  PluginFactory factory{PluginFactory::standardFolders()};
  Simulation simulation;
};

TEST(Refused, StartsThatOverlapSomething) {
  Field field;
  field.simulation.addRobot(named("one"), field.factory, {-4, -2, 0});
  for (const Pose2& start : {Pose2{-4, -2, 0}, Pose2{-3.8, -2.1, 1}, Pose2{2, 1, 0}, Pose2{0, 0, 0},
                             Pose2{-2, 1.3, 0}, Pose2{5.9, 0, 0}, Pose2{std::nan(""), 0, 0}})
    expectIn(complaint([&] { field.simulation.addRobot(named("two"), field.factory, start); }),
             {"robot two", "no room"});
  EXPECT_EQ(field.simulation.robots().size(), 1u);
  field.simulation.step();
}

TEST(Refused, MovablesThatOverlapSomething) {
  const std::string overlapping = std::string(kWorld) + R"(
[[rectangle]]
name = "second crate"
movable = true
mass_kg = 3
center_m = [-2.1, 1.1]
size_m = [0.4, 0.3]
)";
  expectIn(complaint([&] { Simulation(worldOf(overlapping), {}); }), {"second crate", "overlaps"});
}

// A world may be a floor and what is pushed about on it.
TEST(Movables, AreAWorldByThemselvesAndCratesAreOfThem) {
  const std::string crate = R"(
[[rectangle]]
kind = "crate"
mass_kg = 3
center_m = [-2, 1]
size_m = [0.4, 0.2]
)";
  Simulation simulation(worldOf("[world]\nx_m = [-6, 6]\ny_m = [-4, 4]\n" + crate), {});
  ASSERT_EQ(simulation.things().size(), 1u);
  EXPECT_EQ(simulation.things().front().kind, "crate");
  PluginFactory factory{PluginFactory::standardFolders()};
  simulation.addRobot(named("one"), factory, {-4, 1, 0}).setTranslationalVelocity(0.5);
  for (int cycle = 0; cycle < 600; ++cycle) simulation.step();
  EXPECT_GT(simulation.things().front().pose.x, -1.5) << "it was pushed";
  EXPECT_EQ(refusalOf(crate), "") << "without a floor of its own: where it stands";
}

TEST(Refused, TwoRobotsOfOneName) {
  Field field;
  field.simulation.addRobot(named("one"), field.factory, {-4, -2, 0});
  expectIn(complaint([&] { field.simulation.addRobot(named("one"), field.factory, {4, -2, 0}); }),
           {"robot one", "name"});
}

TEST(Refused, MassesAndPiecesOfNoSense) {
  const auto read = [](const std::string& more) {
    return complaint([&] { RobotShape::read(named("odd", more)); });
  };
  for (const char* mass : {"0", "-3", "1e30", "nan", "inf"})
    expectIn(complaint([&] {
               readRobot(parseToml(std::string("[robot]\nmass_kg = ") + mass +
                                       "\n[[sensor]]\nplugin = \"odometry\"",
                                   "robot.toml"));
             }),
             {"robot.toml", "mass_kg"});
  expectIn(read("[[body]]\ncenter_m = [0, 0]\nsize_m = [0, 0.3]"), {"robot.toml", "size_m"});
  expectIn(read("[[body]]\nshape = \"ellipse\"\ncenter_m = [0, 0]\nsize_m = [1e-9, 0.3]"),
           {"size_m"});
  expectIn(read("[[body]]\nshape = \"triangle\"\ncorners_m = [0, 0, 1, 1, 2, 2]"), {"corners_m"});
  expectIn(read("[[body]]\nshape = \"blob\""), {"shape"});
  expectIn(read("[[body]]\ncenter_m = [0, 0]\nsize_m = [1, 1]\nmas = 2"), {"mas"});
  expectIn(read("[[manipulator]]\nname = \"arm\""), {"state"});
  expectIn(read("[[manipulator]]\nname = \"arm\"\n[[manipulator.state]]\nname = \"up\"\n"
                "ball_speed_m_s = 5"),
           {"ball_speed_m_s"});
  EXPECT_EQ(read("[[body]]\ncenter_m = [0, 0]\nsize_m = [0.4, 0.3]"), "");
}

TEST(Refused, CommandsThatAreNotFinite) {
  Field field;
  SimRobot& robot = field.simulation.addRobot(named("one"), field.factory, {-4, -2, 0});
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinite = std::numeric_limits<double>::infinity();
  expectIn(complaint([&] { robot.drive().setTranslationalVelocity(nan); }),
           {"robot one", "finite"});
  expectIn(complaint([&] { robot.drive().setRotationalVelocity(-infinite); }), {"robot one"});
  expectIn(complaint([&] { robot.drive().setCommand(std::array{0.1, nan}); }), {"robot one"});
  expectIn(complaint([&] { robot.drive().setCommand(std::array{0.1}); }),
           {"robot one", "1 numbers", "expected 2"});
  robot.drive().setTranslationalVelocity(1e300);  // its own limits hold
  for (int i = 0; i < 100; ++i) field.simulation.step();
  EXPECT_TRUE(isFinite(robot.state().pose));
  EXPECT_LT(std::abs(robot.state().velocity.x), 1.0);
}

TEST(Contained, APluginThatThrowsInGenerateData) {
  setenv("ORTUNG_PLUGIN_PATH", ORTUNG_PLUGINS_DIR ":" TEST_PLUGINS, 1);
  PluginFactory factory(PluginFactory::standardFolders());
  Simulation simulation(worldOf(kWorld), {});
  SimRobot& robot = simulation.addRobot(
      named("poor", "[[sensor]]\nplugin = \"thrower\"\nafter = 3"), factory, {-4, -2, 0});
  SimRobot& other = simulation.addRobot(named("other"), factory, {4, -2, 0});
  robot.drive().setTranslationalVelocity(0.5);
  std::size_t readings = 0;
  for (int i = 0; i < 100; ++i) {
    simulation.step();
    readings += simulation.readings(0).size();
  }
  ASSERT_EQ(robot.problems().size(), 1u);
  expectIn(robot.problems()[0], {"robot poor", "thrower", "generateData", "out of luck"});
  EXPECT_TRUE(other.problems().empty());
  EXPECT_GT(robot.state().pose.x, -3.7);  // it goes on, and its other sensors measure
  EXPECT_GT(readings, 50u);
}

TEST(Contained, ADriveThatThrowsOrGivesNumbersThatAreNone) {
  setenv("ORTUNG_PLUGIN_PATH", ORTUNG_PLUGINS_DIR ":" TEST_PLUGINS, 1);
  PluginFactory factory(PluginFactory::standardFolders());
  Simulation simulation(worldOf(kWorld), {});
  SimRobot& nan = simulation.addRobot(
      named("lost", "[drive]\nplugin = \"strange_drive\"\nnan = true"), factory, {-4, -2, 0});
  SimRobot& thrower = simulation.addRobot(named("broken", "[drive]\nplugin = \"strange_drive\""),
                                          factory, {4, -2, 0});
  for (int i = 0; i < 20; ++i) simulation.step();
  ASSERT_EQ(nan.problems().size(), 1u);
  expectIn(nan.problems()[0], {"robot lost", "drive", "not finite"});
  ASSERT_EQ(thrower.problems().size(), 1u);
  expectIn(thrower.problems()[0], {"robot broken", "drive", "wheel came off"});
  EXPECT_EQ(nan.state().pose.x, -4.0);
}

/// FNV-1a over the bits of where everything is.
class Hash {
 public:
  void add(double value) {
    std::uint64_t bits;
    std::memcpy(&bits, &value, sizeof bits);
    for (int i = 0; i < 64; i += 8) hash_ = (hash_ ^ (bits >> i & 255u)) * 0x100000001b3u;
  }
  void add(const Pose2& pose) {
    add(pose.x);
    add(pose.y);
    add(pose.theta);
  }
  std::uint64_t value() const { return hash_; }

 private:
  std::uint64_t hash_ = 0xcbf29ce484222325u;
};

/// 100,000 cycles of six robots, a ball and a crate that run into each other all the time.
std::uint64_t crowd(unsigned threads, bool likeVersion02 = false) {
  constexpr int kCycles = 100'000;
  Field field({.seed = 5, .threads = threads, .likeVersion02 = likeVersion02});
  Simulation& simulation = field.simulation;
  Random random(7);
  for (int i = 0; i < 6; ++i)
    simulation.addRobot(named("robot" + std::to_string(i)), field.factory,
                        {-4.0 + 1.6 * i, -2.0, 0.5 * i});
  Hash hash;
  for (int cycle = 0; cycle < kCycles; ++cycle) {
    if (cycle % 50 == 0)
      for (const auto& robot : simulation.robots()) {
        robot->drive().setTranslationalVelocity(random.uniform(-0.8, 0.8));
        robot->drive().setRotationalVelocity(random.uniform(-2.0, 2.0));
      }
    simulation.step();
    if (cycle % 100 != 0) continue;
    for (std::size_t i = 0; i < simulation.robots().size(); ++i) {
      hash.add(simulation.robots()[i]->state().pose);
      hash.add(simulation.robots()[i]->state().odometry);
      for (const Message& message : simulation.readings(i))
        for (const std::uint32_t word : message.words) hash.add(word);
    }
    for (const Simulation::Thing& thing : simulation.things()) hash.add(thing.pose);
  }
  return hash.value();
}

TEST(Reproducible, TheSameWorldBitForBitOver100000CyclesWithAnyThreads) {
  // Of Debian 12 on x86-64: other versions of the mathematical library may round otherwise.
  constexpr std::uint64_t kGolden = 4998910177169937390u;
  const std::uint64_t one = crowd(1);
  EXPECT_EQ(one, crowd(2));
  EXPECT_EQ(one, kGolden);
}

TEST(Reproducible, TheSameWorldBitForBitAsInVersion02) {
  constexpr std::uint64_t kGolden = 8091099281180160995u;
  EXPECT_EQ(crowd(1, true), kGolden);
}

}  // namespace
}  // namespace ortung::test

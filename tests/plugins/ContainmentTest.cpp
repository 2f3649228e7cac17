#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "Files.hpp"
#include "Paths.hpp"
#include "ortung/core/PluginGuard.hpp"
#include "ortung/core/Source.hpp"
#include "ortung/formats/OdometryData.hpp"
#include "ortung/formats/PoseFixData.hpp"
#include "ortung/formats/Words.hpp"
#include "ortung/mcl/Mcl.hpp"
#include "ortung/robot/TomlFile.hpp"
#include "ortung/run/Robot.hpp"
#include "ortung/sim/Learner.hpp"
#include "ortung/sim/Simulation.hpp"

/// Plugins that throw, also what is no std::exception, or give numbers that make no sense, in every
/// function that robots, learner and filter call.
namespace ortung::test {
namespace {

constexpr const char* kWorld =
    "[world]\nx_m = [-6, 6]\ny_m = [-4, 4]\n[[rectangle]]\ncenter_m = [5, 3]\nsize_m = [1, 1]\n";
constexpr const char* kHow[] = {"throw", "int", "nan"};

RobotConfig robotOf(const std::string& more) {
  return readRobot(parseToml("[robot]\nname = \"bob\"\n" + more, "robot.toml"));
}

std::string drive(const std::string& where, const std::string& how, int after) {
  return "[drive]\nplugin = \"misbehaving\"\nwhere = \"" + where + "\"\nhow = \"" + how +
         "\"\nafter = " + std::to_string(after) +
         "\n[[sensor]]\nplugin = \"odometry\"\nperiod_s = 0\n";
}

std::string sensor(const std::string& plugin, const std::string& where, const std::string& how,
                   int after = 0) {
  return "[[sensor]]\nplugin = \"" + plugin + "\"\nwhere = \"" + where + "\"\nhow = \"" + how +
         "\"\nafter = " + std::to_string(after) + "\n";
}

std::unique_ptr<SimWorld> world() {
  const TemporaryFolder folder;
  writeBytes(folder / "world.toml", kWorld);
  return readWorld(folder / "world.toml");
}

void expectIn(const std::string& text, const std::vector<std::string>& parts) {
  for (const std::string& part : parts)
    EXPECT_NE(text.find(part), std::string::npos) << "no \"" << part << "\" in: " << text;
}

/// A robot that plugins fail, and one beside it that accelerates to 0.3 m/s within 0.3 s.
struct Pair {
  explicit Pair(const std::string& bad) {
    robot = &simulation.addRobot(robotOf(bad), factory, {-4, -2, 0});
    RobotConfig good = robotOf(drive("", "throw", 0));
    good.name = "good";
    other = &simulation.addRobot(good, factory, {-4, 2, 0});
  }
  void run(int cycles) {
    for (int i = 0; i < cycles; ++i) simulation.step();
  }

  static Simulation::Config config(std::vector<std::string>& told) {
    Simulation::Config config;
    config.onProblem = [&told](const std::string& problem) { told.push_back(problem); };
    return config;
  }
  PluginFactory factory{{ORTUNG_PLUGINS_DIR, TEST_PLUGINS}};
  std::vector<std::string> told;
  Simulation simulation{test::world(), config(told)};
  SimRobot* robot = nullptr;
  SimRobot* other = nullptr;
};

/// The robot stands from then on, odometry says so, nothing of it is NaN, and the other goes on.
void expectStands(Pair& pair, int cycles) {
  const double stood = pair.robot->state().pose.x;
  pair.run(cycles);
  const RobotState& state = pair.robot->state();
  EXPECT_EQ(state.pose.x, stood);
  EXPECT_TRUE(isFinite(state.pose) && isFinite(state.odometry));
  EXPECT_EQ(state.translationalVelocity, 0.0);
  const auto& odometry =
      dynamic_cast<const OdometryData&>(*pair.robot->container().find({.type = "odometry"}));
  EXPECT_EQ(odometry.reading().translationalVelocity, 0.0);
  EXPECT_NEAR(odometry.reading().pose.x, state.odometry.x, 0.001);
  const double seconds = toSeconds(pair.simulation.now());
  EXPECT_NEAR(pair.other->state().pose.x, -4.0 + 0.3 * (seconds - 0.15), 0.01);
}

TEST(Contained, DrivesThatFailWhileTheyDrive) {
  for (const char* where : {"relocate", "velocity", "measure", "measuredVelocity"})
    for (const char* how : {"throw", "int", "nan", "huge"}) {
      SCOPED_TRACE(std::string(where) + " " + how);
      Pair pair(drive(where, how, 30));
      pair.run(60);
      ASSERT_EQ(pair.robot->problems().size(), 1u);
      expectIn(pair.robot->problems()[0],
               {"the drive plugin 'misbehaving' of robot bob failed in ", where, "switched off"});
      EXPECT_EQ(pair.told, std::vector<std::string>{pair.robot->problems()[0]});
      const std::string why = how == std::string("throw") ? "a wheel came off"
                              : how == std::string("int") ? "no std::exception"
                                                          : "not finite, or faster";
      expectIn(pair.robot->problems()[0], {why});
      EXPECT_NEAR(pair.robot->state().pose.x, -4.0 + 0.3 * 0.15, 0.01);  // until then it drove
      expectStands(pair, 20);
    }
}

TEST(Contained, DrivesThatFailWhenCommanded) {
  for (const char* how : {"throw", "int"}) {
    Pair pair(drive("setTranslationalVelocity", how, 0));
    expectIn(messageOf<PluginFailure>([&] { pair.robot->setTranslationalVelocity(0.1); }),
             {"robot bob", "setTranslationalVelocity"});
    expectIn(messageOf<PluginFailure>([&] { pair.robot->setTranslationalVelocity(0.1); }),
             {"robot bob", "switched off"});
    EXPECT_EQ(pair.robot->problems().size(), 1u);
    expectStands(pair, 40);
  }
}

TEST(Contained, DrivesWhoseLimitsAreNone) {
  for (const char* how : kHow) {
    Pair pair(drive("limits", how, 0));
    expectIn(messageOf<PluginFailure>([&] { pair.robot->drive().limits(); }),
             {"the drive plugin 'misbehaving' of robot bob failed in limits"});
  }
}

TEST(Contained, SensorsThatFail) {
  for (const char* how : kHow) {
    SCOPED_TRACE(how);
    Pair pair(sensor("misbehaving", "generateData", how, 10) + drive("", "throw", 0));
    pair.run(100);
    ASSERT_EQ(pair.robot->problems().size(), 1u);
    expectIn(pair.robot->problems()[0], {"the sensor plugin 'misbehaving' of robot bob",
                                         "bad/misbehaving/pose", "generateData", "switched off"});
    EXPECT_EQ(pair.robot->container().find({.model = "bad"})->sequence(), 10u);
    EXPECT_EQ(pair.robot->container().find({.type = "odometry"})->sequence(), 100u);
    EXPECT_EQ(pair.told.size(), 1u);
  }
}

TEST(Contained, SensorsWhosePeriodOrCostIsNone) {
  for (const char* how : kHow) {
    const std::string period = sensor("misbehaving", "period", how);
    expectIn(messageOf<PluginFailure>([&] { Pair{period}; }), {"robot bob", "period"});
    Pair pair(sensor("misbehaving", "rays", how));
    // A cost of NaN must not pass a server's limit.
    expectIn(messageOf<PluginFailure>([&] { pair.robot->raysPerSecond(0.01); }),
             {"robot bob", "rays"});
  }
}

TEST(Contained, ConstructorsThatFail) {
  for (const char* how : {"throw", "int"}) {
    const std::string bad = drive("construct", how, 0);
    expectIn(messageOf<PluginError>([&] { Pair{bad}; }), {"misbehaving"});
    const std::string worse = sensor("misbehaving", "construct", how);
    expectIn(messageOf<PluginError>([&] { Pair{worse}; }), {"misbehaving"});
  }
}

TEST(Contained, ExtractorsThatFail) {
  for (const char* where : {"take", "extract"})
    for (const char* how : kHow) {
      if (where == std::string("take") && how == std::string("nan")) continue;  // it gives nothing
      SCOPED_TRACE(std::string(where) + " " + how);
      Pair pair(sensor("misbehaving_extracted", where, how, 10) + drive("", "throw", 0));
      pair.run(100);
      ASSERT_EQ(pair.robot->problems().size(), 1u);
      expectIn(pair.robot->problems()[0],
               {"robot bob", "misbehaving_extracted", "bad/extracted/pose", where});
      EXPECT_EQ(pair.robot->container().find({.model = "bad"})->sequence(), 10u);
    }
  const std::string inputs = sensor("misbehaving_extracted", "inputs", "int");
  expectIn(messageOf<PluginFailure>([&] { Pair{inputs}; }), {"misbehaving_extracted", "inputs"});
}

TEST(Contained, SensorsThatFailWhileTablesAreLearned) {
  for (const char* how : kHow) {
    PluginFactory factory({ORTUNG_PLUGINS_DIR, TEST_PLUGINS});
    const RobotConfig config = robotOf(sensor("misbehaving_range", "generateData", how, 10));
    SensorContainer container;
    const std::vector<Device> devices = fillContainer(container, config, factory);
    const auto world = test::world();
    const FieldRegion region = world->region(0.5, {0.2, 0.5});
    expectIn(messageOf<PluginFailure>([&] { learn(*world, region, devices, factory, {}); }),
             {"the sensor plugin 'misbehaving_range' (bad/misbehaving/range)", "generateData"});
  }
}

TEST(Contained, MotionModelsThatFail) {
  PluginFactory factory({ORTUNG_PLUGINS_DIR, TEST_PLUGINS});
  for (const char* where : {"follow", "odometryAt", "sampleMotion", "moments"})
    for (const char* how : kHow)
      for (const unsigned threads : {1u, 2u}) {
        if (where == std::string("follow") && how == std::string("nan")) continue;  // gives nothing
        SCOPED_TRACE(std::string(where) + " " + how);
        MclConfig config;
        config.threads = threads;
        config.maxSamples = config.minSamples = 20'000;  // enough for two threads
        const FieldRegion region = test::world()->region(0.25, {0.2, 0.5});
        auto motion = makeMotion(parseToml("plugin = \"misbehaving\"\nwhere = \"" +
                                               std::string(where) + "\"\nhow = \"" + how + "\"",
                                           "robot.toml"),
                                 factory);
        Mcl mcl(config, region, std::move(motion));
        mcl.startAt(Pose2{}, 0.1, 0.1);
        SensorContainer container;
        auto& fixes = container.add(
            std::make_unique<PoseFixData>(SensorId{"eye", "fix", "pose"}, PoseFixData::Config{}));
        fixes.beginLearning(region, 0.1);
        fixes.endLearning();
        const PoseFixData::Fix anywhere{{}, {1, 0, 0, 0, 1, 0, 0, 0, 1}};
        auto& odometry =
            container.add(std::make_unique<OdometryData>(SensorId{"base", "odometry", "odometry"}));
        const std::string said = messageOf<PluginFailure>([&] {
          for (int i = 0; i < 5; ++i) {
            OdometryData::Reading reading;
            reading.pose.x = i;
            odometry.setData(i * 1'000'000, OdometryData::encode(reading));
            fixes.setData(i * 1'000'000, PoseFixData::encode({&anywhere, 1}));
            mcl.update(container);
          }
        });
        expectIn(said, {"the motion plugin 'misbehaving' failed in ", where});
      }
}

TEST(Contained, MotionModelsThatLearnNoNumber) {
  PluginFactory factory({ORTUNG_PLUGINS_DIR, TEST_PLUGINS});
  for (const char* how : kHow) {
    const auto motion =
        makeMotion(parseToml("plugin = \"misbehaving\"\nwhere = \"endLearning\"\nhow = \"" +
                                 std::string(how) + "\"",
                             "robot.toml"),
                   factory);
    expectIn(messageOf<PluginFailure>([&] { motion->endLearning(); }),
             {"the motion plugin 'misbehaving' failed in endLearning"});
  }
}

TEST(Contained, WordsOfNumbersThatAreNone) {
  const double nan = std::nan("");
  for (const double bad :
       {nan, std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()}) {
    EXPECT_THROW(words::fromMetres(bad), std::invalid_argument);
    EXPECT_THROW(words::fromSignedMetres(bad), std::invalid_argument);
    EXPECT_THROW(words::fromAngle(bad), std::invalid_argument);
    EXPECT_THROW(words::fromRate(bad), std::invalid_argument);
  }
}

/// Whoever localizes with a simulated robot is told, too, instead of going on without a feature.
TEST(Contained, ASourceEndsWithThePluginThatFailed) {
  const TemporaryFolder folder;
  writeBytes(folder / "world.toml", kWorld);
  writeBytes(folder / "robot.toml",
             "[robot]\nname = \"bob\"\n" + sensor("misbehaving", "generateData", "int", 10));
  setenv("ORTUNG_PLUGIN_PATH", ORTUNG_PLUGINS_DIR ":" TEST_PLUGINS, 1);
  PluginFactory factory(PluginFactory::standardFolders());
  Parameters p("sim");
  p.set("path", (folder / "world.toml").string());
  p.set("robot_file", (folder / "robot.toml").string());
  const auto source = factory.make<Source>("sim", p);
  Message message;
  std::size_t readings = 0;
  const std::string said = messageOf<std::runtime_error>([&] {
    while (source->next(message)) readings += message.id.model == "bad" ? 1 : 0;
  });
  expectIn(said, {"the sensor plugin 'misbehaving' of robot bob", "generateData"});
  EXPECT_EQ(readings, 10u);
}

}  // namespace
}  // namespace ortung::test

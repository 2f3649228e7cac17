/// The drivers of bases and of home-made lines, at a server that the test plays.
#include <gtest/gtest.h>

#include <thread>

#include "Await.hpp"
#include "Files.hpp"
#include "ortung/core/PluginFactory.hpp"
#include "ortung/core/RobotCommands.hpp"
#include "ortung/devices/BaseLines.hpp"
#include "ortung/devices/DeviceDriver.hpp"
#include "ortung/devices/Port.hpp"
#include "ortung/emulators/Endpoint.hpp"
#include "ortung/formats/BearingData.hpp"
#include "ortung/formats/ConeData.hpp"
#include "ortung/formats/OdometryData.hpp"

namespace ortung {
namespace {

using namespace base_lines;
using test::comesTrue;
using test::messageOf;

constexpr std::chrono::milliseconds kPatience{5000};  // nothing here lasts as long

/// A driver, and the other end of its line.
struct Driver : testing::Test {
  Driver()
      : left({"sonar", "ultrasonic", "left"}, {}, {}),
        wheels({"odometry", "odometry", "pose"}),
        right({"sonar", "ultrasonic", "right"}, {}, {}) {}
  void make(const std::string& plugin, Parameters parameters = Parameters("robot.toml")) {
    parameters.set("port", end.name());
    driver = factory.make<DeviceDriver>(plugin, parameters);
  }
  /// A base with two sonars and wheels.
  void makeBase() {
    make("base");
    const std::vector<const SensorData*> features{&left, &wheels, &right};
    driver->serve(features);
  }
  /// Opens the driver, while the other end answers its first question.
  void openAnswered(const std::string& answer) {
    const std::jthread other([&](const std::stop_token& stop) {
      std::string asked;
      while (!stop.stop_requested() && asked.find('\n') == asked.npos) end.read(asked);
      EXPECT_EQ(asked.substr(0, asked.find('\n') + 1), encode(base_lines::Question{}));
      end.write(answer);
    });
    driver->open();
  }
  /// Sends bytes, and returns the readings that come of them.
  std::vector<DeviceReading> take(const std::string& bytes, std::size_t count) {
    end.write(bytes);
    std::vector<DeviceReading> readings;
    EXPECT_TRUE(comesTrue("there are so many readings", [&] {
      if (readings.size() < count) driver->read(kPatience, readings);
      return readings.size() >= count;
    }));
    return readings;
  }
  TcpEndpoint end{0};
  PluginFactory factory{PluginFactory::standardFolders()};
  std::unique_ptr<DeviceDriver> driver;
  ConeData left;  // sees 3 m
  OdometryData wheels;
  ConeData right;
};

using BaseDriver = Driver;
using LinesDriver = Driver;

// After 49 days its 32 bits of milliseconds begin again; a little back is not the future.
TEST_F(BaseDriver, CountsTheBasesClockOn) {
  makeBase();
  openAnswered(encode(Identity{1, 2}));
  std::vector<Timestamp> times;
  std::string lines;
  for (const std::uint32_t time : {4294967290U, 5U, 3U, 1000U})
    lines += encode(base_lines::Odometry{.time = time, .motionData = {}});
  for (const DeviceReading& reading : take(lines, 4)) times.push_back(*reading.deviceTime);
  const Timestamp first = 4294967290LL * 1000;
  EXPECT_EQ(times,
            (std::vector<Timestamp>{first, first + 11'000, first + 9'000, first + 1'006'000}));
}

TEST_F(BaseDriver, GivesOdometryAsItsFeatureReadsIt) {
  makeBase();
  openAnswered(encode(Identity{1, 2}));
  const auto readings =
      take(encode(base_lines::Odometry{1, {1.5, -0.25, 0.5}, 0.3, -0.2, 0.125, {7}}), 1);
  ASSERT_EQ(readings.size(), 1u);
  EXPECT_EQ(readings[0].feature, 1u);
  wheels.setData(0, readings[0].words);
  EXPECT_NEAR(wheels.reading().pose.x, 1.5, 1e-3);
  EXPECT_NEAR(wheels.reading().pose.y, -0.25, 1e-3);
  EXPECT_NEAR(wheels.reading().pose.theta, 0.5, 2e-4);
  EXPECT_NEAR(wheels.reading().translationalVelocity, 0.3, 1e-3);
  EXPECT_NEAR(wheels.reading().rotationalVelocity, -0.2, 2e-4);
  EXPECT_NEAR(wheels.reading().lateralVelocity, 0.125, 1e-3);
  EXPECT_EQ(wheels.reading().motionData, std::vector<std::uint32_t>{7});
}

// Sonars are numbered in the order of the robot file; no echo means that nothing was seen.
TEST_F(BaseDriver, GivesEchoesToTheSonarsInTheirOrder) {
  makeBase();
  openAnswered(encode(Identity{1, 5}));
  const auto readings = take(encode(Sonars{20, 1, {0, 700}}) + encode(Sonars{20, 0, {500}}), 2);
  ASSERT_EQ(readings.size(), 2u) << "there is no sonar 2";
  EXPECT_EQ(readings[0].feature, 2u);
  EXPECT_EQ(readings[0].words, std::vector<std::uint32_t>{3001});
  EXPECT_EQ(readings[1].feature, 0u);
  EXPECT_EQ(readings[1].words, std::vector<std::uint32_t>{500});
  EXPECT_EQ(readings[1].deviceTime, 20'000);
}

TEST_F(BaseDriver, ABaseThatDoesNotFitIsAMisfit) {
  makeBase();
  EXPECT_EQ(messageOf<DeviceMisfit>([&] { openAnswered(encode(Identity{2, 2})); }),
            end.name() + ": speaks version 2 of the lines, expected 1");
  driver->close();
  EXPECT_EQ(messageOf<DeviceMisfit>([&] { openAnswered(encode(Identity{1, 1})); }),
            end.name() + ": has 1 sonars, the robot file 2");
}

TEST_F(BaseDriver, CountsDamagedLinesAndThoseBehindNoise) {
  makeBase();
  openAnswered("noise\r\n" + encode(Identity{1, 2}));
  EXPECT_EQ(driver->refused(), 1u);
  std::string damaged = encode(Sonars{1, 0, {500}});
  damaged[3] = '9';
  EXPECT_EQ(
      take(damaged + "noise" + encode(Sonars{2, 0, {501}}) + encode(Sonars{3, 0, {502}}), 2).size(),
      2u);
  EXPECT_EQ(driver->refused(), 3u);
}

TEST_F(BaseDriver, TellsTheBaseWhatTheRobotIsTold) {
  makeBase();
  openAnswered(encode(Identity{1, 2}));
  RobotCommands* const commands = driver->commands();
  ASSERT_NE(commands, nullptr);
  const auto told = [&] {
    std::vector<DeviceReading> none;
    std::string line;
    while (line.find('\n') == line.npos) {
      driver->read(std::chrono::milliseconds(0), none);
      end.read(line);
    }
    return line.substr(0, line.find('\n') + 1);
  };
  const std::vector<double> motion{0.25, -0.5}, three{1, 2, 3}, fast{10.5, 0}, turning{0, -20.5};
  commands->setMotion(motion);
  EXPECT_EQ(told(), encode(Velocity{0.25, -0.5}));
  commands->setTranslationalVelocity(-10.0);
  EXPECT_EQ(told(), encode(Velocity{-10.0, -0.5})) << "the turn is the same";
  EXPECT_THROW(commands->setMotion(three), std::invalid_argument);
  EXPECT_THROW(commands->setMotion(fast), std::invalid_argument);
  EXPECT_THROW(commands->setMotion(turning), std::invalid_argument);
  EXPECT_THROW(commands->setTranslationalVelocity(10.1), std::invalid_argument);
  EXPECT_THROW(commands->setRotationalVelocity(std::nan("")), std::invalid_argument);
  EXPECT_THROW(commands->setManipulator("kicker", "1"), std::invalid_argument);
  EXPECT_EQ(told(), encode(Velocity{-10.0, -0.5})) << "what was refused has changed nothing";
}

TEST_F(BaseDriver, RefusesOtherFeaturesAndSpeeds) {
  make("base");
  const BearingData compass({"compass", "compass", "north"}, {}, {});
  const std::vector<const SensorData*> features{&compass};
  EXPECT_EQ(messageOf<std::invalid_argument>([&] { driver->serve(features); }),
            "compass/compass/north is neither a sonar nor the only odometry");
  for (const char* plugin : {"base", "lines"}) {
    Parameters slow("robot.toml");
    slow.set("baud", 12345.0);
    EXPECT_NE(
        messageOf<ConfigError>([&] { make(plugin, slow); }).find("is no speed of a serial line"),
        std::string::npos);
  }
}

TEST_F(LinesDriver, TakesTheLinesOfItsFeatures) {
  make("lines");
  const std::vector<const SensorData*> features{&left, &right};
  driver->serve(features);
  driver->open();
  std::string ignored;
  end.read(ignored);  // accepts the driver
  const auto readings = take(
      "tail of a line\n"               // the first one may have begun before
      "# a remark\n\nnot a reading\n"  // this one is refused
      "7 sonar/ultrasonic/right 1 1500\r\n"
      "8 sonar/ultrasonic/other 1 1500\n"
      "9 sonar/ultrasonic/left 1 700\n",
      2);
  ASSERT_EQ(readings.size(), 2u);
  EXPECT_EQ(readings[0].feature, 1u);
  EXPECT_EQ(readings[0].words, std::vector<std::uint32_t>{1500});
  EXPECT_EQ(readings[0].deviceTime, 7);
  EXPECT_EQ(readings[1].feature, 0u);
  EXPECT_EQ(driver->refused(), 1u);
}

TEST_F(LinesDriver, MayHaveNoClock) {
  Parameters parameters("robot.toml");
  parameters.set("has_clock", false);
  make("lines", parameters);
  const std::vector<const SensorData*> features{&left};
  driver->serve(features);
  driver->open();
  std::string ignored;
  end.read(ignored);
  EXPECT_FALSE(take("7 sonar/ultrasonic/left 1 1500\n", 1)[0].deviceTime);
}

}  // namespace
}  // namespace ortung

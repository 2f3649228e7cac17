/// The devices of a robot file: which tables are one device, and which settings are refused.
#include <gtest/gtest.h>

#include <atomic>

#include "Await.hpp"
#include "Files.hpp"
#include "ortung/devices/RobotDevices.hpp"
#include "ortung/emulators/Endpoint.hpp"
#include "ortung/formats/OdometryData.hpp"
#include "ortung/robot/TomlFile.hpp"

namespace ortung {
namespace {

/// A robot file, and what its devices are.
class RobotDevicesTest : public testing::Test {
 protected:
  std::vector<DeviceSettings> read(const std::string& toml, const std::string& dev = "") {
    container_ = std::make_unique<SensorContainer>();
    robot_ = readRobot(parseToml(toml, "robot.toml"));
    features_ = fillContainer(*container_, robot_, factory_);
    return readDevices(robot_, features_, dev);
  }
  std::string complaint(const std::string& toml) {
    return test::messageOf<ConfigError>([&] { read(toml); });
  }
  static std::string wheels(const std::string& more = "") {
    return "[[sensor]]\nplugin = 'odometry'\ndevice = { plugin = 'base', port = '/dev/ttyS0'" +
           more + " }\n";
  }
  static std::string sonars(const std::string& device) {
    return "[[sensor]]\nplugin = 'sonar'\nangles_deg = [0, 90]\ndevice = { " + device + " }\n";
  }
  PluginFactory factory_{PluginFactory::standardFolders()};
  std::unique_ptr<SensorContainer> container_;
  RobotConfig robot_;
  std::vector<Device> features_;
};

TEST_F(RobotDevicesTest, HaveDefaults) {
  const auto devices = read(wheels());
  ASSERT_EQ(devices.size(), 1u);
  EXPECT_EQ(devices[0].plugin, "base");
  EXPECT_EQ(devices[0].port, "/dev/ttyS0");
  EXPECT_EQ(devices[0].parameters.text("port"), "/dev/ttyS0");
  EXPECT_EQ(devices[0].intake.health.staleAfter, 1.0);
  EXPECT_EQ(devices[0].intake.health.reopenAfter, 5.0);
  EXPECT_EQ(devices[0].intake.clock.lateAfter, 0.5);
  EXPECT_FALSE(devices[0].latency);
  EXPECT_FALSE(devices[0].repeats);
  ASSERT_EQ(devices[0].features.size(), 1u);
  EXPECT_EQ(toText(devices[0].features[0]->id()), "odometry/odometry/pose");
}

TEST_F(RobotDevicesTest, TakeTheirSettingsFromTheirTable) {
  const auto devices = read(wheels(
      ", stale_after_s = 2.5, late_after_s = 3, most_per_s = 20, latency_s = 0.25, repeats = 7"));
  EXPECT_EQ(devices[0].intake.health.staleAfter, 2.5);
  EXPECT_EQ(devices[0].intake.health.reopenAfter, 7.5) << "three times as long";
  EXPECT_EQ(devices[0].intake.clock.lateAfter, 3.0);
  EXPECT_EQ(devices[0].intake.mostPerSecond, 20.0);
  EXPECT_EQ(devices[0].latency, 0.25);
  EXPECT_EQ(devices[0].repeats, 7u);
}

TEST_F(RobotDevicesTest, TablesOfOnePluginAndPortAreOneDevice) {
  const auto one = read(wheels() + sonars("plugin = 'base', port = '/dev/ttyS0'"));
  ASSERT_EQ(one.size(), 1u);
  ASSERT_EQ(one[0].features.size(), 3u);
  EXPECT_EQ(one[0].features[0]->id().type, "odometry");
  EXPECT_EQ(one[0].features[2]->id().type, "ultrasonic");
  EXPECT_EQ(read(wheels() + sonars("plugin = 'base', port = '/dev/ttyS1'")).size(), 2u);
  EXPECT_EQ(read(wheels() + sonars("plugin = 'lines', port = '/dev/ttyS0'")).size(), 2u);
}

TEST_F(RobotDevicesTest, TheFirstTableHasTheSettings) {
  const std::string error =
      complaint(wheels() + sonars("plugin = 'base', port = '/dev/ttyS0', baud = 9600"));
  EXPECT_NE(error.find("baud is in the second table of base at /dev/ttyS0; expected all settings "
                       "in the first one, plugin and port alone here"),
            std::string::npos)
      << error;
}

TEST_F(RobotDevicesTest, RefuseSettingsOutOfRange) {
  for (const std::string setting :
       {"late_after_s = 0.005", "late_after_s = 61", "stale_after_s = 0.005",
        "stale_after_s = 3601", "most_per_s = 0.5", "most_per_s = 100001", "latency_s = -0.1",
        "latency_s = 10.5", "repeats = -1", "repeats = 1.5"}) {
    const std::string key = setting.substr(0, setting.find(' '));
    EXPECT_NE(complaint(wheels(", " + setting)).find(key), std::string::npos)
        << complaint(wheels(", " + setting));
  }
  EXPECT_NE(
      complaint("[[sensor]]\nplugin = 'odometry'\ndevice = { plugin = 'base' }\n").find("port"),
      std::string::npos);
}

TEST_F(RobotDevicesTest, ARobotWithoutADeviceIsRefused) {
  EXPECT_NE(
      complaint("[[sensor]]\nplugin = 'odometry'\n")
          .find(": names no device; expected device = { plugin = \"...\", port = \"...\" } in "
                "a [[sensor]]"),
      std::string::npos);
}

// Emulated devices have their links in another folder; other ports stay where they are.
TEST_F(RobotDevicesTest, TheFolderOfDevicesMayBeAnother) {
  const auto moved = read(wheels(), "/run/desk");
  EXPECT_EQ(moved[0].port, "/dev/ttyS0") << "as the user knows it";
  EXPECT_EQ(moved[0].parameters.text("port"), "/run/desk/ttyS0");
  for (const std::string port : {"tcp:localhost:7000", "/devices/x", "/tmp/dev/x"}) {
    const auto kept = read(sonars("plugin = 'base', port = '" + port + "'"), "/run/desk");
    EXPECT_EQ(kept[0].parameters.text("port"), port);
  }
  const auto relative = read(wheels(), "desk");
  EXPECT_EQ(relative[0].parameters.text("port"),
            (std::filesystem::current_path() / "desk/ttyS0").string());
}

/// Two compasses that stamp nothing, at a time that the test says.
class TwoCompasses : public RobotDevicesTest {
 protected:
  static constexpr Timestamp kSecond = 1'000'000;

  TwoCompasses() {
    std::string toml;
    for (const std::size_t i : {0u, 1u})
      toml += "[[sensor]]\nplugin = 'compass'\nmodel = 'c" + std::to_string(i) +
              "'\ndevice = { plugin = 'lines', port = '" + ends_[i].name() +
              "', has_clock = false, latency_s = 0, stale_after_s = 1000 }\n";
    devices_ =
        std::make_unique<RobotDevices>(read(toml), kWait, factory_, [this] { return now_.load(); });
    for (const std::size_t i : {0u, 1u})
      EXPECT_TRUE(test::comesTrue("the device is open", [&] {
        std::string said;
        ends_[i].read(said);
        return devices_->status()[i].openings == 1;
      }));
  }
  /// A device gives a reading at a time [s].
  void measure(std::size_t device, int seconds) {
    now_ = seconds * kSecond;
    std::string said;
    ends_[device].read(said);  // takes its connection
    ends_[device].write("0 c" + std::to_string(device) + "/compass/north 1 " +
                        std::to_string(18000 + seconds) + "\n");
    const std::uint64_t before = readings_[device]++;
    EXPECT_TRUE(test::comesTrue("the reading is there",
                                [&] { return devices_->status()[device].readings == before + 1; }));
  }
  /// The next reading that need not wait, as "DEVICE at SECONDS", if it is there now.
  std::string next() { return next(std::chrono::milliseconds(0)); }
  /// The same where one must come: it is counted a moment before it can be had.
  std::string soon() { return next(std::chrono::seconds(10)); }
  std::string next(std::chrono::milliseconds patience) {
    const auto message = devices_->next(patience);
    return message ? message->id.model + " at " + std::to_string(message->stamp / kSecond) : "none";
  }
  static constexpr double kWait = 100.0;  // [s]
  std::atomic<Timestamp> now_ = 0;
  TcpEndpoint ends_[2] = {TcpEndpoint(0), TcpEndpoint(0)};
  std::uint64_t readings_[2] = {0, 0};
  std::unique_ptr<RobotDevices> devices_;
};

TEST_F(TwoCompasses, WaitForOneAnotherUpToTheTimeThatTheyMay) {
  measure(0, 1);
  EXPECT_EQ(soon(), "c0 at 1") << "nobody waits for a device's first reading";
  measure(1, 2);
  EXPECT_EQ(next(), "none") << "the first one may have one of before";
  measure(0, 3);
  EXPECT_EQ(soon(), "c1 at 2");
  EXPECT_EQ(next(), "none");
  now_ = 103 * kSecond - 1;
  EXPECT_EQ(next(), "none");
  now_ = 103 * kSecond;
  EXPECT_EQ(soon(), "c0 at 3");
}

TEST_F(TwoCompasses, GiveWhatWaitsAtTheEndOfTheRun) {
  measure(0, 1);
  measure(1, 2);
  measure(1, 3);
  EXPECT_EQ(soon(), "c0 at 1");
  EXPECT_EQ(next(), "none");
  devices_->finish();
  measure(0, 4);
  EXPECT_EQ(soon(), "c1 at 2");
  EXPECT_EQ(soon(), "c1 at 3");
  EXPECT_EQ(next(), "none") << "the one at 4 s came behind the end";
}

TEST_F(TwoCompasses, DoNotWaitForOneThatIsGone) {
  measure(0, 1);
  measure(1, 1);
  EXPECT_EQ(soon(), "c0 at 1");
  EXPECT_EQ(soon(), "c1 at 1");
  ends_[0].unplug();
  EXPECT_TRUE(test::comesTrue("it is gone",
                              [&] { return devices_->status()[0].state == DeviceState::kAbsent; }));
  measure(1, 2);
  EXPECT_EQ(soon(), "c1 at 2");
}

}  // namespace
}  // namespace ortung

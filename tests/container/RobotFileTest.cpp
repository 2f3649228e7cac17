#include <gtest/gtest.h>

#include "Files.hpp"
#include "ortung/robot/RobotFile.hpp"
#include "ortung/robot/TomlFile.hpp"

namespace ortung {
namespace {

template <class Action>
std::string complaint(const Action& action) {
  return test::messageOf<ConfigError>(action);
}

RobotConfig read(const std::string& text) { return readRobot(parseToml(text, "r.toml")); }

TEST(RobotFile, GivesSensorsAndSections) {
  const RobotConfig robot = read(
      "[robot]\nname = 'pioneer'\nradius_m = 0.3\n[[sensor]]\nplugin = 'lrf'\nbeams = "
      "7\n[[sensor]]\nplugin = 'odometry'\n"
      "[motion]\nway_per_m = 0.2\n[mcl]\nparticles = 10\n[drive]\nspeed_m_s = 1\n");
  EXPECT_EQ(robot.name, "pioneer");
  EXPECT_EQ(robot.radius, 0.3);
  ASSERT_EQ(robot.sensors.size(), 2u);
  EXPECT_EQ(robot.sensors[0].plugin, "lrf");
  EXPECT_EQ(robot.sensors[0].parameters.integer("beams"), 7);
  EXPECT_EQ(robot.motion.number("way_per_m"), 0.2);
  EXPECT_EQ(robot.mcl.integer("particles"), 10);
  EXPECT_EQ(robot.drive.number("speed_m_s"), 1.0);
}

TEST(RobotFile, KeepsDevicesApartForWhoeverOpensThem) {
  const RobotConfig robot = read(
      "[devices]\nwait_s = 0.2\n[[sensor]]\nplugin = 'odometry'\ndevice = { plugin = 'base', port "
      "= "
      "'/dev/ttyUSB0', whatever = 1 }\n[[sensor]]\nplugin = 'odometry'\n");
  EXPECT_EQ(robot.deviceWait, 0.2);
  EXPECT_EQ(robot.sensors[0].device.text("plugin"), "base");
  EXPECT_TRUE(robot.sensors[1].device.keys().empty());
  robot.sensors[0].parameters.text("plugin");
  robot.sensors[0].parameters.refuseUnread();  // simulator and learner pass `device` over
  EXPECT_EQ(complaint([] { read("[[sensor]]\nplugin = 'a'\n[devices]\nwait = 1\n"); }),
            "r.toml:4: wait is not known here (did you mean 'wait_s'?); known are wait_s");
}

TEST(RobotFile, SaysWhatIsWrong) {
  EXPECT_EQ(complaint([] { read("[robot]\nname = 'x'\n"); }),
            "r.toml: sensor is missing: a robot file has at least one [[sensor]]");
  EXPECT_EQ(complaint([] { read("[[sensor]]\nbeams = 1\n"); }),
            "r.toml:1: plugin is missing; there are beams");
  EXPECT_EQ(complaint([] { read("[[sensor]]\nplugin = 'a'\n[robot]\nradius_m = -1\n"); }),
            "r.toml:4: radius_m is -1, must be in [0.001, 100]");
  EXPECT_EQ(complaint([] { read("[[sensor]]\nplugin = 'a'\n[robot]\nradus_m = 1\n"); }),
            "r.toml:4: radus_m is not known here (did you mean 'radius_m'?); known are colour, "
            "mass_kg, name, radius_m");
  EXPECT_EQ(complaint([] { read("[[sensor]]\nplugin = 'a'\n[sensr]\n"); }),
            "r.toml:3: sensr is not known here; sections of a robot file are [robot], [[sensor]], "
            "[motion], [mcl], [drive], [devices], [[body]] and [[manipulator]]");
  EXPECT_EQ(complaint([] { read("[sensor]\nplugin = 'a'\n"); }),
            "r.toml:1: sensor is a table, expected tables [[sensor]]");
  std::string many;
  for (int i = 0; i < 65; ++i) many += "[[sensor]]\nplugin = 'a'\n";
  EXPECT_NE(complaint([&] { read(many); }).find("occurs more than 64 times"), std::string::npos);
}

TEST(RobotFile, SensorNamesHaveDefaultsAndAreChecked) {
  const Parameters good = parseToml("model = 'LMS200'\n", "r.toml");
  EXPECT_EQ(sensorIdOf(good, {"any", "LRF", "scan"}), (SensorId{"LMS200", "LRF", "scan"}));
  const Parameters bad = parseToml("model = 'LMS 200'\n", "r.toml");
  EXPECT_EQ(complaint([&] { sensorIdOf(bad, {"any", "LRF", "scan"}); }),
            "r.toml:1: model and its companions: the sensor's model must be 1 to 64 characters of "
            "[A-Za-z0-9_.-]");
}

TEST(RobotFile, NamesThePluginThatIsMissing) {
  const RobotConfig robot = read("[[sensor]]\nplugin = 'nosuch'\n");
  PluginFactory factory;
  SensorContainer container;
  const std::string message =
      test::messageOf<PluginError>([&] { fillContainer(container, robot, factory); });
  EXPECT_NE(message.find("there is no plugin 'nosuch' of kind ortung.SensorData; there is none (in "
                         "the empty search path"),
            std::string::npos)
      << message;
  EXPECT_TRUE(message.starts_with("r.toml:2: plugin ")) << message;
}

}  // namespace
}  // namespace ortung

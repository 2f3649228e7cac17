#include <gtest/gtest.h>

#include <vector>

#include "ortung/base/Parameters.hpp"
#include "ortung/robot/RobotText.hpp"

namespace ortung {
namespace {

constexpr const char* kRobot = R"([robot]
name = "späher"  # of München

[[sensor]]
plugin = "odometry"

# what sees
[[sensor]]
plugin = "lrf"  # a SICK
sigma_m = 0.05  # guessed
pose = { x_m = 0.1, z_m = 0.3 }  # über dem Rad

[mcl]
particles = 500
)";

std::string changed(const std::string& text, std::size_t sensor, std::vector<TomlEntry> entries) {
  return withSensorKeys(text, "robot.toml", sensor, entries);
}

TEST(RobotText, ChangesKeysOfOneSensorAndLeavesComments) {
  std::string wanted = kRobot;
  wanted.replace(wanted.find("0.05"), 4, "0.0213");
  const std::string pose = "{ x_m = 0.1, z_m = 0.3 }";
  wanted.replace(wanted.find(pose), pose.size(), "{ x_m = 0.12 }");
  wanted.insert(wanted.find("sigma_m"), "bias_m = -0.01\n");
  EXPECT_EQ(
      changed(kRobot, 1, {{"sigma_m", "0.0213"}, {"bias_m", "-0.01"}, {"pose", "{ x_m = 0.12 }"}}),
      wanted);
}

TEST(RobotText, AddsAKeyAtTheVeryEndOfAText) {
  EXPECT_EQ(changed("[[sensor]]\nplugin = \"lrf\"", 0, {{"bias_m", "0.1"}}),
            "[[sensor]]\nplugin = \"lrf\"\nbias_m = 0.1\n");
}

TEST(RobotText, RefusesWhatItCantChangeInPlace) {
  EXPECT_THROW(changed(kRobot, 2, {{"sigma_m", "1"}}), ConfigError);
  EXPECT_THROW(changed("sensor = [{ plugin = \"lrf\" }]\n", 0, {{"sigma_m", "1"}}), ConfigError);
  EXPECT_THROW(changed("no toml", 0, {{"sigma_m", "1"}}), ConfigError);
  EXPECT_THROW(changed("[[sensor]]\nplugin = \"lrf\"\n[sensor.pose]\nx_m = 1\n", 0,
                       {{"pose", "{ x_m = 2 }"}}),
               ConfigError);
}

}  // namespace
}  // namespace ortung

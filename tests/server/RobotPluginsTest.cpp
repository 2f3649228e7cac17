#include <gtest/gtest.h>

#include "Files.hpp"
#include "ortung/robot/NetworkRobot.hpp"
#include "ortung/server/RobotPlugins.hpp"

namespace ortung::test {
namespace {

constexpr std::string_view kData[] = {SensorData::kInterface};
constexpr std::string_view kUnknown[] = {"ortung.Nothing/1"};

TEST(RobotPlugins, WhatIsOfferedUnderAnotherInterfaceIsRefusedByName) {
  PluginFactory factory({TEST_PLUGINS});
  const std::vector<std::string> plugins = robotPlugins(factory, kData);
  EXPECT_EQ(plugins, std::vector<std::string>{"yardstick"});
  EXPECT_EQ(messageOf<ConfigError>([&] {
              readNetworkRobot("[[sensor]]\nplugin = \"oracle\"\n", "robot file", plugins);
            }),
            "robot file:2: plugin is not one of the plugins of this server: yardstick");
}

TEST(RobotPlugins, AListWithNothingOnItIsAnError) {
  PluginFactory factory({TEST_PLUGINS});
  EXPECT_THROW(robotPlugins(factory, kUnknown), PluginError);
  EXPECT_THROW(robotPlugins(factory, {}), PluginError);
}

}  // namespace
}  // namespace ortung::test

// Robot files that strangers send.
#include <gtest/gtest.h>

#include "Files.hpp"
#include "ortung/robot/NetworkRobot.hpp"

namespace ortung::test {
namespace {

const std::vector<std::string> kPlugins = {"lrf", "differential"};

std::string complaintAbout(const std::string& toml) {
  return messageOf<ConfigError>([&] { readNetworkRobot(toml, "robot file", kPlugins); });
}

const std::string kScanner = "[[sensor]]\nplugin = \"lrf\"\n";

TEST(NetworkRobot, KeysThatCouldNameAFileAreRefusedWhereverTheyStand) {
  const std::string why = " names a file, which a configuration from the network must not";
  for (const std::string key : {"file", "path", "table_file", "table_path", "_file", "_path"}) {
    EXPECT_EQ(complaintAbout(kScanner + key + " = \"x\"\n"), "robot file:3: " + key + why);
    EXPECT_EQ(complaintAbout(kScanner + key + " = 5\n"), "robot file:3: " + key + why);
    EXPECT_EQ(complaintAbout(kScanner + "[drive]\nlist = [1, [{ " + key + " = \"x\" }]]\n"),
              "robot file:4: " + key + why);
    EXPECT_EQ(complaintAbout(key + " = \"x\"\n" + kScanner), "robot file:1: " + key + why);
  }
}

TEST(NetworkRobot, TextsThatCouldBePathsAreRefused) {
  const std::string why =
      " has a slash or a control character, which a configuration from the network must not";
  for (const std::string text : {"a/b", "/", "a\\\\b", "a\\tb", "\\u0000", "\\u007f"}) {
    EXPECT_EQ(complaintAbout(kScanner + "feature = \"" + text + "\"\n"),
              "robot file:3: feature" + why)
        << text;
    EXPECT_EQ(complaintAbout(kScanner + "list = [[\"" + text + "\"]]\n"),
              "robot file:3: list" + why)
        << text;
  }
}

TEST(NetworkRobot, PluginsAreThoseOfTheListInEveryPartThatTheServerReads) {
  const std::string why = ": plugin is not one of the plugins of this server: lrf differential";
  EXPECT_EQ(complaintAbout("[[sensor]]\nplugin = \"sonar\"\n"), "robot file:2" + why);
  EXPECT_EQ(complaintAbout(kScanner + "[drive]\nplugin = \"omni\"\n"), "robot file:4" + why);
  EXPECT_EQ(complaintAbout(kScanner + "[[sensor]]\nplugin = \"lrf\"\ndeep = { plugin = \"x\" }\n"),
            "robot file:5" + why);
}

TEST(NetworkRobot, WhatTracksTheRobotIsTheClientsOwn) {
  const RobotConfig robot =
      readNetworkRobot("[robot]\nradius_m = 0.3\n" + kScanner +
                           "[motion]\nplugin = \"neural\"\nnetwork_file = \"/home/anna/net.json\"\n"
                           "[mcl]\nmap_path = \"..\\\\maps\"\nplugin = \"none\"\n[drive]\nplugin = "
                           "\"differential\"\n",
                       "robot file", kPlugins);
  EXPECT_EQ(robot.radius, 0.3);
  EXPECT_EQ(robot.sensors.size(), 1u);
  EXPECT_EQ(robot.drive.text("plugin"), "differential");
  EXPECT_TRUE(robot.motion.keys().empty());
  EXPECT_TRUE(robot.mcl.keys().empty());
}

TEST(NetworkRobot, OtherSectionsOfTheseNamesAreNotTheClients) {
  EXPECT_EQ(complaintAbout(kScanner + "[drive.motion]\nnetwork_file = \"x\"\n"),
            "robot file:4: network_file names a file, which a configuration from the network must "
            "not");
  EXPECT_NE(complaintAbout("motion = 5\n" + kScanner), "");
}

}  // namespace
}  // namespace ortung::test

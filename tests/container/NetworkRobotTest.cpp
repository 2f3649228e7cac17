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

TEST(NetworkRobot, HasAtMost32PiecesInAllItsStates) {
  const std::string box = "center_m = [0, 0]\nsize_m = [0.2, 0.1]\n";
  const auto pieces = [&](const std::string& table, const std::string& shape, int count) {
    std::string text;
    for (int i = 0; i < count; ++i) text += "[[" + table + "]]\nshape = \"" + shape + "\"\n" + box;
    return text;
  };
  EXPECT_EQ(complaintAbout(kScanner + pieces("body", "rectangle", 32)), "(nothing was thrown)");
  EXPECT_EQ(complaintAbout(kScanner + pieces("body", "rectangle", 33)),
            "robot file:131: body is one too many: a robot from the network has at most 32 pieces "
            "in all its states (an ellipse counts 8)");
  EXPECT_EQ(complaintAbout(kScanner + pieces("body", "ellipse", 4)), "(nothing was thrown)");
  EXPECT_NE(complaintAbout(kScanner + pieces("body", "ellipse", 5)), "(nothing was thrown)");
  const std::string arm = "[[manipulator]]\nname = \"arm\"\n";
  const std::string state = "[[manipulator.state]]\nname = \"s\"\n";
  const auto states = [&](int each) {
    return pieces("body", "rectangle", 20) + arm + state +
           pieces("manipulator.state.body", "rectangle", each) + state +
           pieces("manipulator.state.body", "rectangle", each);
  };
  EXPECT_EQ(complaintAbout(kScanner + states(6)), "(nothing was thrown)");
  EXPECT_NE(complaintAbout(kScanner + states(7)), "(nothing was thrown)");
  // However it is written.
  std::string flat = "body = [";
  for (int i = 0; i < 33; ++i) flat += "{ center_m = [0, 0], size_m = [0.2, 0.1] },";
  EXPECT_NE(complaintAbout(flat + "]\n" + kScanner), "(nothing was thrown)");
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
  EXPECT_EQ(complaintAbout("motion = 5\n" + kScanner),
            "robot file:1: motion is a whole number, expected a table [motion]");
}

}  // namespace
}  // namespace ortung::test

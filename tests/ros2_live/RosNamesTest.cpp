// Names of topics, what a launch file says on the command line, and files of parameters.
#include <gtest/gtest.h>

#include <fstream>
#include <stdexcept>

#include "../support/Files.hpp"
#include "ParamsFile.hpp"
#include "RosArguments.hpp"
#include "RosNames.hpp"

namespace ortung::ros2 {
namespace {

TEST(RosNames, AreOfTheNamespaceUnlessTheyBeginWithASlash) {
  RosNames names{.node = "amcl"};
  EXPECT_EQ(names.full(), "/amcl");
  EXPECT_EQ(names.resolve("scan"), "/scan");
  EXPECT_EQ(names.resolve("~/get_state"), "/amcl/get_state");
  names.space = "/robot1";
  EXPECT_EQ(names.full(), "/robot1/amcl");
  EXPECT_EQ(names.resolve("scan"), "/robot1/scan");
  EXPECT_EQ(names.resolve("/tf"), "/tf");
  EXPECT_EQ(names.resolve("~/get_state"), "/robot1/amcl/get_state");
  EXPECT_EQ(names.resolve("~"), "/robot1/amcl");
}

TEST(RosNames, AreRemappedWholeAndTheFirstRuleCounts) {
  // As nav2_bringup does where several robots are told apart by namespaces.
  const RosNames names{.node = "amcl",
                       .space = "/robot1",
                       .remaps = {{"/tf", "tf"}, {"scan", "/lidar"}, {"scan", "/other"}}};
  EXPECT_EQ(names.resolve("/tf"), "/robot1/tf");
  EXPECT_EQ(names.resolve("scan"), "/lidar");
  EXPECT_EQ(names.resolve("/robot1/scan"), "/lidar") << "it is the same name";
  EXPECT_EQ(names.resolve("/scan"), "/scan");
  EXPECT_EQ(names.resolve("/tf_static"), "/tf_static");
}

TEST(RosNames, AreWordsBetweenSlashes) {
  EXPECT_NO_THROW((RosNames{.node = "a_1", .space = "/b/c2"}.check()));
  for (const char* node : {"", "1a", "a b", "a/b", "a-b"})
    EXPECT_THROW(RosNames{.node = node}.check(), std::invalid_argument) << node;
  for (const char* space : {"", "a", "/a/", "//", "/1", "/a//b"})
    EXPECT_THROW((RosNames{.node = "a", .space = space}.check()), std::invalid_argument) << space;
  EXPECT_THROW((RosNames{.remaps = {{"scan", "/li dar"}}}.check()), std::invalid_argument);
}

TEST(RosArguments, AreThoseOfLaunchFiles) {
  const auto all = RosArguments::read({"--belief",
                                       "b",
                                       "--ros-args",
                                       "-r",
                                       "__node:=finder",
                                       "-r",
                                       "__ns:=/r1",
                                       "--remap",
                                       "scan:=lidar",
                                       "-r",
                                       "finder:odom:=/wheels",
                                       "-r",
                                       "other:map:=/no",
                                       "--params-file",
                                       "p.yaml",
                                       "-p",
                                       "alpha1:=0.3",
                                       "--log-level",
                                       "info",
                                       "--disable-rosout-logs",
                                       "--",
                                       "--seed",
                                       "3"},
                                      "amcl");
  EXPECT_EQ(all.others, (std::vector<std::string>{"--belief", "b", "--seed", "3"}));
  EXPECT_EQ(all.names.full(), "/r1/finder");
  EXPECT_TRUE(all.namesNode);
  EXPECT_EQ(all.names.resolve("scan"), "/r1/lidar");
  EXPECT_EQ(all.names.resolve("odom"), "/wheels");
  EXPECT_EQ(all.names.resolve("map"), "/r1/map") << "the rule is for another node";
  ASSERT_EQ(all.parameters.size(), 2U);
  EXPECT_EQ(all.parameters[0].file, "p.yaml");
  EXPECT_EQ(all.parameters[1].name, "alpha1");
  EXPECT_EQ(all.parameters[1].value, "0.3");
}

TEST(RosArguments, NameWhatTheyDoNotUnderstand) {
  const auto why = [](const std::vector<std::string>& words) -> std::string {
    try {
      RosArguments::read(words, "amcl");
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(why({"--anything"}), "") << "it is not for ROS";
  EXPECT_NE(why({"--ros-args", "--anything"}).find("--anything"), std::string::npos);
  EXPECT_NE(why({"--ros-args", "-r"}).find("missing"), std::string::npos);
  EXPECT_NE(why({"--ros-args", "-r", "scan=lidar"}).find("NAME:=VALUE"), std::string::npos);
  EXPECT_NE(why({"--ros-args", "-p", "alpha1:="}).find("NAME:=VALUE"), std::string::npos);
  EXPECT_NE(why({"--ros-args", "-r", "__ns:=robot"}).find("namespace"), std::string::npos);
}

class ParamsFileTest : public testing::Test {
 protected:
  std::filesystem::path write(const std::string& text) const {
    std::ofstream(folder_ / "p.yaml") << text;
    return folder_ / "p.yaml";
  }
  ParameterTexts read(const std::string& text, const RosNames& names = {.node = "amcl"}) const {
    return readParamsFile(write(text), names);
  }
  std::string why(const std::string& text) const {
    try {
      read(text);
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "";
  }
  test::TemporaryFolder folder_;
};

TEST_F(ParamsFileTest, GivesWhatIsForTheNode) {
  const std::string text =
      "/**:\n  ros__parameters: {use_sim_time: true}\n"
      "amcl:\n  ros__parameters:\n    alpha1: 0.1\n    initial_pose: {x: 1.5, yaw: -2}\n"
      "    laser_model_type: \"beam\"\n"
      "other:\n  ros__parameters: {alpha1: 9}\n"
      "robot1:\n  amcl:\n    ros__parameters: {alpha2: 0.4}\n"
      "/*/amcl:\n  ros__parameters: {alpha3: 0.5}\n";
  EXPECT_EQ(read(text), (ParameterTexts{{"use_sim_time", "true", true},
                                        {"alpha1", "0.1"},
                                        {"initial_pose.x", "1.5"},
                                        {"initial_pose.yaw", "-2"},
                                        {"laser_model_type", "beam"}}));
  EXPECT_EQ(read(text, {.node = "amcl", .space = "/robot1"}),
            (ParameterTexts{{"use_sim_time", "true", true}, {"alpha2", "0.4"}, {"alpha3", "0.5"}}));
}

TEST_F(ParamsFileTest, TellsWhereItIsWrong) {
  EXPECT_NE(why("other:\n  ros__parameters: {a: 1}\n").find("of /other, expected those of /amcl"),
            std::string::npos);
  EXPECT_NE(why("amcl:\n  ros__parameters: 3\n").find("p.yaml:2"), std::string::npos);
  EXPECT_NE(why("amcl: [\n").find("p.yaml:"), std::string::npos);
  EXPECT_NE(why("").find("p.yaml"), std::string::npos);
  EXPECT_NE(why(std::string(2 << 20, ' ')).find("larger"), std::string::npos);
  EXPECT_THROW(readParamsFile(folder_ / "none.yaml", {}), std::runtime_error);
  // Aliases that would make a billion of nine.
  std::string bomb = "a: &a {x: 1}\n";
  for (char c = 'b'; c < 'l'; ++c) {
    bomb += std::string(1, c) + ": &" + c + " {";
    for (int i = 0; i < 9; ++i)
      bomb += std::string(i == 0 ? "" : ", ") + "y" + std::to_string(i) + ": *" + char(c - 1);
    bomb += "}\n";
  }
  EXPECT_NE(why("amcl:\n  ros__parameters: {a: 1}\n" + bomb).find("fewer"), std::string::npos);
  EXPECT_NE(why(std::string(100'000, '[')), "");
}

}  // namespace
}  // namespace ortung::ros2

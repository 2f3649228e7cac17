// Bags as robots of others record them, as sources.
#include <cmath>
#include <fstream>
#include <limits>
#include <random>

#include "BagMaker.hpp"
#include "LogTesting.hpp"
#include "Ros1Maker.hpp"
#include "ortung/formats/OdometryData.hpp"

namespace ortung {
namespace {

using namespace ortung::testing;
using namespace ros2;
using Texts = std::vector<std::string>;

constexpr float kInfinity = std::numeric_limits<float>::infinity();

class BagSource : public ::testing::Test {
 protected:
  std::string write(BagMaker& maker, const std::string& name = "run.mcap") const {
    return "mcap:" + folder_.write(name, maker.bytes()).string();
  }
  TemporaryFolder folder_;
};

TEST_F(BagSource, GivesScansAndOdometryInMillimetresAtTheirOwnTimes) {
  BagMaker maker;
  maker.add("/odom", odometryAt(2 * kSecond, 1.25, 0.5))
      .add("/scan", scanOf(kSecond + 1999, "base_footprint",
                           {1.5F, 0.0F, kInfinity}));  // the nanoseconds are cut off
  maker.add("/scan", scanOf(2 * kSecond, "base_footprint", {-kInfinity, std::nanf(""), 8.2F}));
  EXPECT_EQ(asText(readAll(write(maker))),
            (Texts{"1000001 laser/LRF/scan 1500 0 8101",
                   "2000000 odometry/odometry/pose 2147484898 2147483648 18000 2147484148 "
                   "2147483648",
                   "2000000 laser/LRF/scan 0 0 8101"}));
}

TEST_F(BagSource, SeveralScannersSitWhereTheTreeOfFramesSaysEvenUpsideDown) {
  // base_footprint -> base_link (0.1 m up) -> front: 0.2 m ahead; rear: looks back, hangs upside
  // down: turned by 180 degrees about its x axis, then about z.
  BagMaker maker;
  maker.add("/odom", odometryAt(kSecond, 0.0, 0.0))
      .add("/tf_static", frameAt("base_footprint", "base_link", {{0, 0, 0.1}, {}}))
      .add("/tf_static", frameAt("base_link", "front", {{0.2, 0, 0.2}, {0, 0, 0, 1}}))
      .add("/tf_static", frameAt("base_link", "rear", {{-0.3, 0.05, 0.2}, {0, 1, 0, 0}}))
      .add("/tf", frameAt("odom", "base_footprint", {{5, 5, 0}, {}}, kSecond))
      .add("/front/scan", scanOf(kSecond, "front", {1.0F, 2.0F, 3.0F}))
      .add("/rear/scan", scanOf(kSecond, "rear", {1.0F, 2.0F, 3.0F}));
  const std::string text = write(maker);
  const auto source = makeSource(text);
  const auto messages = readAll(*source);
  EXPECT_EQ(asText(only(messages, "front_scan/LRF/scan")),
            (Texts{"1000000 front_scan/LRF/scan 1000 2000 3000"}));
  // Its beams run clockwise as seen from above, so the last one is the first.
  EXPECT_EQ(asText(only(messages, "rear_scan/LRF/scan")),
            (Texts{"1000000 rear_scan/LRF/scan 3000 2000 1000"}));
  const std::string toml = source->robotToml();
  EXPECT_NE(toml.find("pose = { x_m = 0.2, y_m = 0.0, theta_deg = 0.0 }\nbeams = 3\n"
                      "first_angle_deg = -28.647"),
            toml.npos)
      << toml;
  EXPECT_NE(toml.find("pose = { x_m = -0.3, y_m = 0.05, theta_deg = 180.0 }"), toml.npos) << toml;
  EXPECT_NE(toml.find("max_range_m = 8.1\n"), toml.npos) << toml;
  EXPECT_EQ(source->remark(), "");
  EXPECT_EQ(only(readAll(text + "?scans=/rear/scan"), "laser/LRF/scan").size(), 1u);
}

TEST_F(BagSource, ATiltedScannerIsRefusedAndALonelyFrameIsTold) {
  BagMaker tilted;
  const double half = std::sqrt(0.5);
  tilted.add("/odom", odometryAt(0, 0, 0))
      .add("/tf_static", frameAt("base_footprint", "laser", {{0, 0, 0}, {0, half, 0, half}}))
      .add("/scan", scanOf(0, "laser", {1.0F, 2.0F, 3.0F}));
  EXPECT_NE(errorOf(write(tilted)).find("tilted by 90 degrees"), std::string::npos);
  EXPECT_EQ(errorOf("mcap:" + (folder_.path() / "run.mcap").string() + "?mounts=laser:0.1,0,90"),
            "");
  BagMaker lonely;
  lonely.add("/odom", odometryAt(0, 0, 0)).add("/scan", scanOf(0, "laser", {1.0F, 2.0F, 3.0F}));
  const auto source = makeSource(write(lonely));
  EXPECT_NE(
      source->remark().find("the mount of frame 'laser' of /scan in 'base_footprint' is not known"),
      std::string::npos)
      << source->remark();
}

TEST_F(BagSource, ScansWithOtherBeamsAreFittedToTheFirst) {
  LaserScan finer = scanOf(kSecond, "base_footprint", {1.0F, 1.5F, 2.0F, 2.5F, 3.0F});
  finer.angleIncrement = 0.25F;
  BagMaker maker;
  maker.add("/scan", scanOf(0, "base_footprint", {1.0F, 2.0F, 3.0F})).add("/scan", finer);
  LaserScan elsewhere = scanOf(2 * kSecond, "base_footprint", {1.0F});
  elsewhere.angleMin = 3.0F;
  maker.add("/scan", elsewhere).add("/odom", odometryAt(0, 0, 0));
  const auto source = makeSource(write(maker));
  EXPECT_EQ(asText(only(readAll(*source), "laser/LRF/scan")),
            (Texts{"0 laser/LRF/scan 1000 2000 3000", "1000000 laser/LRF/scan 1000 2000 3000"}));
  EXPECT_NE(source->remark().find("1 messages of /scan have other beams"), std::string::npos)
      << source->remark();
  EXPECT_NE(source->remark().find("1 messages of /scan reach beyond"), std::string::npos);
}

TEST_F(BagSource, OdometryAndTruthMayComeFromTheTreeOfFramesAlone) {
  BagMaker maker;
  maker.add("/scan", scanOf(0, "base_link", {1.0F, 2.0F, 3.0F}))
      .add("/tf", frameAt("odom", "base_link", {{1, 0, 0}, {}}, kSecond))
      .add("/tf", frameAt("map", "odom", {{10, 0, 0}, {}}, kSecond))
      .add("/tf", frameAt("odom", "base_link", {{3, 0, 0}, {}}, 2 * kSecond));
  const auto messages = readAll(write(maker) + "?truth=tf");
  // 2 m in 1 s.
  EXPECT_EQ(asText(only(messages, "odometry/odometry/pose")).at(1),
            "2000000 odometry/odometry/pose 2147486648 2147483648 18000 2147485648 2147483648");
  EXPECT_EQ(asText(only(messages, "reference/groundTruth/pose")),
            (Texts{"2000000 reference/groundTruth/pose 2147496648 2147483648 18000"}));
}

TEST_F(BagSource, PosesThatAreCalledGroundTruthAreTheReference) {
  PoseStamped pose;
  pose.header.stamp = 5;
  pose.pose.orientation = {0, 0, 1, 0};
  BagMaker maker;
  maker.add("/ground_truth", pose).add("/goal_pose", pose);
  EXPECT_EQ(asText(readAll(write(maker))),
            (Texts{"0 reference/groundTruth/pose 2147483648 2147483648 0"}));
  EXPECT_NE(errorOf("mcap:" + (folder_.path() / "run.mcap").string() + "?truth=none")
                .find("found no reading"),
            std::string::npos);
}

TEST_F(BagSource, AFolderOfFilesIsOneBag) {
  for (const int number : {2, 10}) {
    BagMaker maker;
    maker.add("/odom", odometryAt(number * kSecond, number, 0.0));
    write(maker, "bag_" + std::to_string(number) + ".mcap");
  }
  EXPECT_EQ(readAll("mcap:" + folder_.path().string()).size(), 2u);
}

TEST_F(BagSource, MapsBecomeWorlds) {
  OccupancyGrid map;
  map.resolution = 0.05F;
  map.width = 3;
  map.height = 2;
  map.origin.position = {-1.0, 2.0, 0.0};
  map.data = {0, 100, -1, 10, 50, 90};
  BagMaker maker;
  maker.add("/map", map).add("/odom", odometryAt(0, 0, 0));
  const auto source = makeSource(write(maker));
  source->writeWorld(folder_.path() / "w.toml");
  const std::string image = readBytes(folder_.path() / "w.pgm");
  using namespace std::string_literals;
  EXPECT_EQ(image, "P5\n3 2\n255\n\xFE\xCD\x00\xFE\x00\xCD"s);  // the top row first
  const std::string yaml = readBytes(folder_.path() / "w.yaml");
  EXPECT_NE(yaml.find("resolution: 0.05\norigin: [-1.0, 2.0, 0]\n"), yaml.npos) << yaml;
  map.origin.orientation = {0.0, 0.0, std::sin(0.3), std::cos(0.3)};
  BagMaker turned;
  turned.add("/map", map).add("/odom", odometryAt(0, 0, 0));
  makeSource(write(turned))->writeWorld(folder_.path() / "w.toml");
  EXPECT_EQ(readBytes(folder_.path() / "w.pgm"), image);
  const std::string text = readBytes(folder_.path() / "w.yaml");
  const std::string start = "origin: [-1.0, 2.0, ";
  EXPECT_NEAR(std::stod(text.substr(text.find(start) + start.size())), 0.6, 1e-12) << text;
  map.origin.orientation = {0.0, 0.0, 0.0, 0.0};
  BagMaker left;  // without a rotation, as some write it
  left.add("/map", map).add("/odom", odometryAt(0, 0, 0));
  makeSource(write(left))->writeWorld(folder_.path() / "w.toml");
  EXPECT_EQ(readBytes(folder_.path() / "w.yaml"), yaml);
  map.data.pop_back();
  BagMaker torn;
  torn.add("/map", map);
  EXPECT_NE(errorOf(write(torn)).find("a map of 3 x 2 cells of 0.05"), std::string::npos);
}

// Of a plugin's own format ROS sees ranges; its words are in a channel beside them.
TEST_F(BagSource, WhatAPluginsOwnFormatReadComesBackAsItsWordsAlone) {
  ros2::Range range;
  range.header = {kSecond, "radar"};
  range.fieldOfView = 0.5F;
  range.maxRange = 8.0F;
  range.range = 2.0F;
  Words words;
  words.data = {2000, 7};
  BagMaker maker;
  maker.add("/odom", odometryAt(kSecond, 0.0, 0.0))
      .add("/range/acme/echo", range, "cdr",
           {{"ortung_feature", "acme/radar/echo"}, {"format", "radar row=range_mm,other"}})
      .add("/ortung/acme/radar/echo", words, "cdr", {{"ortung_feature", "acme/radar/echo"}});
  const auto messages = readAll(write(maker));
  const auto radar = only(messages, "acme/radar/echo");
  ASSERT_EQ(radar.size(), 1u);
  EXPECT_EQ(radar.front().words, words.data);
}

TEST_F(BagSource, MessagesInAnotherEncodingAreRefused) {
  BagMaker maker;
  maker.add("/scan", scanOf(0, "laser", {1.0F}), "json");
  EXPECT_NE(errorOf(write(maker)).find("/scan: found messages in 'json', expected cdr"),
            std::string::npos);
}

// As `mcap convert` makes it of a bag of ROS 1.
TEST_F(BagSource, MessagesOfRos1InMcapAreReadAsThose) {
  std::string bytes;
  McapWriter writer([&](std::string_view piece) { bytes += piece; }, {});
  const auto schema = writer.addSchema("nav_msgs/Odometry", "ros1msg", "");
  writer.write(writer.addChannel(schema, "/odom", "ros1", {}), 1,
               toRos1(odometryAt(2 * kSecond, 1.25, 0.5)));
  writer.finish();
  EXPECT_EQ(asText(readAll("mcap:" + folder_.write("run.mcap", bytes).string())),
            (Texts{"2000000 odometry/odometry/pose 2147484898 2147483648 18000 2147484148 "
                   "2147483648"}));
}

TEST_F(BagSource, NumbersThatAreNoneNeverComeIn) {
  BagMaker maker;
  maker.add("/odom", odometryAt(0, std::nan(""), 0.0)).add("/odom", odometryAt(1000, 1.0, 0.0));
  const auto source = makeSource(write(maker));
  EXPECT_EQ(readAll(*source).size(), 1u);
  EXPECT_NE(source->remark().find("1 messages of /odom have a "), std::string::npos);
}

TEST_F(BagSource, DamagedBagsAreReadOrRefused) {
  BagMaker maker;
  maker.add("/odom", odometryAt(0, 1.0, 0.5))
      .add("/tf_static", frameAt("base_footprint", "laser", {{0.1, 0, 0}, {}}))
      .add("/scan", scanOf(0, "laser", {1.0F, 2.0F, 3.0F}))
      .add("/tf", frameAt("odom", "base_footprint", {{1, 0, 0}, {}}));
  const std::string whole = maker.bytes();
  std::mt19937 random(1);
  int read = 0;
  for (int i = 0; i < 400; ++i) {
    const std::string text = "mcap:" + folder_.write("run.mcap", mutated(whole, random)).string();
    try {
      const auto source = makeSource(text);
      for (const Message& message : readAll(*source)) EXPECT_FALSE(message.words.empty());
      source->robotToml();
      ++read;
    } catch (const std::runtime_error& error) {
      EXPECT_NE(std::string(error.what()).find("run.mcap"), std::string::npos) << error.what();
    }
  }
  EXPECT_GT(read, 0);
  EXPECT_LT(read, 400);
}

}  // namespace
}  // namespace ortung

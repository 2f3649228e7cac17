// Files that people have must stay readable: each format as it was when it was new.
#include <gtest/gtest.h>

#include <limits>
#include <numbers>

#include "Golden.hpp"
#include "TableUser.hpp"
#include "ortung/formats/OdometryData.hpp"
#include "ortung/formats/PoseFixData.hpp"
#include "ortung/motion/MotionNetwork.hpp"
#include "ortung/records/RecordSource.hpp"
#include "ortung/records/RecordWriter.hpp"
#include "ortung/robot/MotionNetworkFile.hpp"
#include "ortung/robot/RobotFile.hpp"
#include "ortung/robot/TableInfo.hpp"

namespace ortung {
namespace {

using test::expectGolden;
using test::goldenFile;
using test::readBytes;
using test::TemporaryFolder;
using Words = std::vector<std::uint32_t>;

constexpr double kPi = std::numbers::pi;

const std::vector<Message> kMessages = {
    {std::numeric_limits<Timestamp>::min(), {"a", "b", "c"}, {}},
    {-5, {"LMS200", "LRF", "180DegreeScan"}, {0, 1, 4294967295}},
    {0, {"odometry", "odometry", "pose"}, {2147483648, 2147483647, 18000, 2147484148, 2147483648}},
    {0, {"M-1_x.y", "T", "F"}, {7}},
    {1700000000123456, {"reference", "groundTruth", "pose"}, {2147484148, 2147482148, 35999}}};

TEST(GoldenRecord, IsWrittenAsItWas) {
  const TemporaryFolder folder;
  RecordWriter writer(folder / "x.txt", "00f315bae1fde647");
  for (const Message& message : kMessages) writer.write(message);
  writer.commit();
  expectGolden("record1.rec", readBytes(folder / "x.txt"));
}

/// kMessages, and a reading that is too large for a line.
std::vector<Message> withPicture() {
  std::vector<Message> messages = kMessages;
  Words pixels = {160, 120, 1};
  for (std::uint32_t i = 0; i < 4800; ++i) pixels.push_back(0x01010101U * (i / 100) + i % 7);
  messages.push_back({1700000000123457, {"camera", "image", "front"}, pixels});
  return messages;
}

void expectRead(const std::string& name, const std::vector<Message>& messages) {
  RecordSource source(goldenFile(name));
  EXPECT_EQ(source.worldFingerprint(), "00f315bae1fde647");
  Message message;
  for (const Message& expected : messages) {
    ASSERT_TRUE(source.next(message));
    EXPECT_EQ(message, expected);
  }
  EXPECT_FALSE(source.next(message));
  EXPECT_EQ(source.remark(), "");
}

// How zstd compresses may change with its versions, so that what is written is not compared.
TEST(GoldenRecord, IsReadAsItWas) {
  expectRead("record1.rec", kMessages);
  expectRead("record2.rec", withPicture());
}

/// One command, one hidden layer of two neurons.
MotionNetwork smallNetwork() {
  MotionNetwork n;
  n.step = 0.05;
  n.commands = 1;
  n.fromVelocities = true;
  n.limit = {2.0, 3.5};
  n.inputMean = {0.1, 0.0, 0.2, -0.3};
  n.inputScale = {2.0, 1.0, 4.0, 1.0 / 3.0};
  n.outputScale = {0.01, 0.02, 0.03, 0.04, 0.05};
  n.layers = {{4, 2, {0.5, 0.0, -0.25, 1.0, 1e-9, -7.0, 0.125, 2.0}, {0.125, -1.0}},
              {2, 5, {1, 2, 3, 4, 5, 6, 7, 8, 9, 10}, {0, 0.1, 0, 0, -0.1}}};
  return n;
}

TEST(GoldenNetwork, IsWrittenAsItWas) { expectGolden("network1.json", toJson(smallNetwork())); }

TEST(GoldenNetwork, IsReadAsItWas) {
  const MotionNetwork read = readMotionNetwork(goldenFile("network1.json"));
  const MotionNetwork expected = smallNetwork();
  EXPECT_EQ(read.step, 0.05);
  EXPECT_EQ(read.commands, 1u);
  EXPECT_TRUE(read.fromVelocities);
  EXPECT_EQ(read.limit.translational, 2.0);
  EXPECT_EQ(read.limit.rotational, 3.5);
  EXPECT_EQ(read.inputMean, expected.inputMean);
  EXPECT_EQ(read.inputScale, expected.inputScale);
  EXPECT_EQ(read.outputScale, expected.outputScale);
  ASSERT_EQ(read.layers.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(read.layers[i].inputs, expected.layers[i].inputs);
    EXPECT_EQ(read.layers[i].outputs, expected.layers[i].outputs);
    EXPECT_EQ(read.layers[i].weights, expected.layers[i].weights);
    EXPECT_EQ(read.layers[i].bias, expected.layers[i].bias);
  }
}

/// A field of 3 x 2 cells of 1 m; nothing can be in the last, a robot can stand in the first two.
FieldRegion smallRegion() {
  return {{-1.5, -1.0, 1.0, 3, 2}, {1, 1, 1, 1, 1, 0}, {1, 1, 0, 0, 0, 0}};
}

/// A feature of each format. What they learn is made of the number of the cell and nothing else.
struct SmallRobot {
  SmallRobot() {
    test::fillForTables(container);
    container.add(std::make_unique<PoseFixData>(SensorId{"LMS200", "LRF", "position"},
                                                PoseFixData::Config{}));
    container.add(std::make_unique<OdometryData>(SensorId{"base", "odometry", "pose"}));
  }

  /// What a feature sees in a cell, in the quarter turn that its heading is.
  static Words wordsOf(const std::string& feature, std::uint32_t cell, std::uint32_t quarter) {
    if (feature == "post1Distance") return {1000 + 250 * cell};
    if (feature == "post1Bearing") return {18000 + 1000 * cell};
    if (feature == "posts") return {7, 2000 + cell, 9000 + 100 * cell};
    if (feature == "lines") return {750, 18000};  // 0.75 m ahead
    if (feature == "front") return {quarter == 3 ? 3001 : 500 + 100 * cell + 300 * quarter};
    if (feature == "rays") return {1000 + 100 * cell, 2000 + 100 * cell, 0, 8001};
    if (feature == "points") return {0, 750, 0, 8001};  // a point 0.75 m ahead
    return {};
  }

  void learn(const FieldRegion& region) {
    for (const auto& data : container.all()) {
      if (!data->localizes()) continue;
      data->beginLearning(region, kPi / 2);
      const std::uint32_t quarters = data->id().feature == "front" ? 4 : 1;
      for (std::uint32_t cell = 0; cell < region.grid.size(); ++cell) {
        if (region.open[cell] == 0) continue;
        for (std::uint32_t quarter = 0; quarter < quarters; ++quarter) {
          const Words words = wordsOf(data->id().feature, cell, quarter);
          if (data->id().feature != "position") data->setData(1, words);
          data->learnProbability(
              {region.grid.centreX(cell), region.grid.centreY(cell), quarter * kPi / 2});
        }
      }
      data->endLearning();
    }
  }
  const SensorData& feature(std::string_view name) const {
    return *container.find({.feature = name});
  }

  SensorContainer container;
};

TEST(GoldenTables, AreWrittenAsTheyWere) {
  const FieldRegion region = smallRegion();
  SmallRobot robot;
  robot.learn(region);
  const TemporaryFolder folder;
  writeTables(folder / "x.ortung", robot.container,
              {"small", "00f315bae1fde647", "robot", kPi / 2, region, {}});
  expectGolden("tables3.ortung", readBytes(folder / "x.ortung"));
}

TEST(GoldenTables, TellWhatTheyTold) {
  const TableInfo info = readTableInfo(TableFile(goldenFile("tables1.ortung")));
  EXPECT_EQ(info.world, "small");
  EXPECT_EQ(info.worldFingerprint, "00f315bae1fde647");
  EXPECT_EQ(info.robot, "robot");
  EXPECT_EQ(info.headingStep, kPi / 2);
  EXPECT_EQ(info.region.grid, smallRegion().grid);
  EXPECT_EQ(info.region.open, smallRegion().open);
  EXPECT_EQ(info.region.standable, smallRegion().standable);
  ASSERT_EQ(info.features.size(), 8u);
  EXPECT_EQ(info.features[0].id, "cam/camera/post1Distance");
  EXPECT_EQ(info.features[0].key, "distance max_range_m=20 fov_rad=0 mount=0,0,0");
  EXPECT_EQ(info.features[0].prefix, "cam.camera.post1Distance.");
}

TEST(GoldenTables, HoldTheSameNumbers) {
  const TableFile file(goldenFile("tables1.ortung"));
  const auto is = [&](const std::string& name, std::size_t columns,
                      const std::vector<std::uint16_t>& expected) {
    const auto found = file.get<std::uint16_t>(name, {expected.size() / columns, columns});
    EXPECT_EQ(std::vector<std::uint16_t>(found.begin(), found.end()), expected) << name;
  };
  // [mm], and parts of a turn of which there are 65535.
  is("cam.camera.post1Distance.distance", 3, {1000, 1250, 1500, 1750, 2000, 65535});
  is("cam.camera.post1Bearing.direction", 3, {0, 1820, 3641, 5461, 7282, 65535});
  is("cam.camera.posts.7.distance", 3, {2000, 2001, 2002, 2003, 2004, 65535});
  is("cam.camera.posts.7.direction", 3, {49151, 49333, 49515, 49697, 49879, 65535});
  is("cam.camera.posts.4000000000.distance", 3, std::vector<std::uint16_t>(6, 65535));
  const auto rows = file.get<std::int32_t>("LMS200.LRF.rays.row_of_cell", {2, 3});
  EXPECT_EQ(std::vector<std::int32_t>(rows.begin(), rows.end()),
            (std::vector<std::int32_t>{0, 1, 2, 3, 4, -1}));
  EXPECT_EQ(file.get<std::int32_t>("LMS200.LRF.rays.directions", {1})[0], 4);
}

TEST(GoldenTables, SayWhatTheySaidOfPoses) {
  SmallRobot robot;
  loadTables(std::make_shared<const TableFile>(goldenFile("tables1.ortung")), robot.container);
  const Pose2 inCellOne{0.2, -0.6, 0.0};
  const auto expected = [&](std::string_view feature, const Pose2& pose) {
    return robot.feature(feature).expectation(pose);
  };
  EXPECT_NEAR(expected("post1Distance", inCellOne)[0], 1.25, 1e-6);
  EXPECT_NEAR(expected("post1Bearing", {0.2, -0.6, 0.5})[0], kPi / 18 - 0.5, 5e-5);
  EXPECT_NEAR(expected("posts", inCellOne)[0], 2.001, 1e-6);
  EXPECT_NEAR(expected("posts", inCellOne)[1], -kPi / 2 + kPi / 180, 5e-5);
  EXPECT_TRUE(std::isnan(expected("posts", inCellOne)[2])) << "the second was never seen";
  EXPECT_TRUE(expected("front", {1.0, 0.5, 0.0}).empty()) << "no sensor can be there";
  // Levels of ranges are a fraction of sigma apart.
  for (const double quarter : {0.0, 1.0, 2.0})
    EXPECT_NEAR(expected("front", {0.2, -0.6, quarter * kPi / 2})[0], 0.6 + 0.3 * quarter, 0.01);
  EXPECT_EQ(expected("front", {0.2, -0.6, -kPi / 2})[0], 3.0) << "nothing is within reach";
  const std::vector<double> ranges = expected("rays", inCellOne);
  ASSERT_EQ(ranges.size(), 4u);
  EXPECT_NEAR(ranges[0], 1.1, 0.03);
  EXPECT_NEAR(ranges[1], 2.1, 0.03);
  EXPECT_EQ(ranges[3], 8.0);
}

TEST(GoldenTables, GiveTheSameProbabilitiesOfPoints) {
  SmallRobot robot;
  loadTables(std::make_shared<const TableFile>(goldenFile("tables1.ortung")), robot.container);
  for (const char* name : {"lines", "points"}) {
    SensorData* feature = robot.container.find({.feature = name});
    feature->setData(1, SmallRobot::wordsOf(name, 0, 0));
    EXPECT_NEAR(feature->getProbability({0.0, -0.5, 0.0}), 1.0, 1e-6) << name;
    EXPECT_LT(feature->getProbability({0.0, -0.5, kPi / 2}), 0.95) << name;
    EXPECT_EQ(feature->getProbability({9.0, 0.0, 0.0}), kNoExpectation) << name;
  }
}

}  // namespace
}  // namespace ortung

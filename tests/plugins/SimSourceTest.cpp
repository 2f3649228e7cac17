#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>

#include "Paths.hpp"
#include "ortung/core/PluginFactory.hpp"
#include "ortung/core/Source.hpp"
#include "ortung/formats/OdometryData.hpp"
#include "ortung/formats/PoseData.hpp"
#include "ortung/robot/RobotFile.hpp"
#include "ortung/sim/SimWorld.hpp"

namespace ortung {
namespace {

constexpr const char* kWorld = ORTUNG_SOURCE_DIR "/maps/fields/soccer18x12.toml";
constexpr const char* kRobot = ORTUNG_SOURCE_DIR "/maps/robots/pioneer.toml";

using Options = std::map<std::string, std::string>;

/// The source as the program makes it: options are text.
struct SimRun {
  explicit SimRun(const Options& options, const std::string& robot = kRobot)
      : factory(PluginFactory::standardFolders()) {
    Parameters p("sim:soccer18x12.toml");
    p.set("path", kWorld);
    p.set("robot_file", robot);
    for (const auto& [key, value] : options) p.set(key, value);
    source = factory.make<Source>("sim", p);
  }

  std::vector<Message> all() {
    std::vector<Message> messages;
    for (Message message; source->next(message);) messages.push_back(message);
    return messages;
  }

  PluginFactory factory;
  std::unique_ptr<Source> source;
};

std::vector<Pose2> posesOf(const std::vector<Message>& messages, const std::string& type) {
  std::vector<Pose2> poses;
  OdometryData odometry({"a", "b", "c"});
  PoseData truth({"a", "b", "c"});
  for (const Message& message : messages) {
    if (message.id.type != type) continue;
    if (type == "odometry") {
      odometry.setData(message.stamp, message.words);
      poses.push_back(odometry.reading().pose);
    } else {
      truth.setData(message.stamp, message.words);
      poses.push_back(truth.reading());
    }
  }
  return poses;
}

TEST(SimSource, TellsOfARunInTheOrderOfTime) {
  SimRun run(Options{{"duration", "5"}, {"seed", "7"}});
  const std::vector<Message> messages = run.all();
  std::set<std::string> types;
  Timestamp last = 0;
  for (const Message& message : messages) {
    EXPECT_GE(message.stamp, last);
    last = message.stamp;
    types.insert(message.id.type);
  }
  EXPECT_EQ(last, 5'000'000);
  EXPECT_EQ(types, (std::set<std::string>{"LRF", "camera", "groundTruth", "odometry"}));
  EXPECT_EQ(run.source->progress(), 1.0);
  EXPECT_EQ(run.source->worldFingerprint(), readWorld(kWorld)->fingerprint());
}

TEST(SimSource, FillsTheContainerOfItsRobot) {
  SimRun run(Options{{"duration", "0.5"}});
  SensorContainer container;
  fillContainer(container, readRobot(std::filesystem::path(kRobot)), run.factory);
  for (const Message& message : run.all())
    EXPECT_TRUE(container.set(message)) << toText(message.id);
  for (const auto& data : container.all()) EXPECT_GT(data->sequence(), 0u) << toText(data->id());
}

TEST(SimSource, GivesTheSameBitsForTheSameSeed) {
  EXPECT_EQ(SimRun(Options{{"duration", "3"}, {"seed", "5"}}).all(),
            SimRun(Options{{"duration", "3"}, {"seed", "5"}}).all());
  EXPECT_NE(SimRun(Options{{"duration", "3"}, {"seed", "5"}}).all(),
            SimRun(Options{{"duration", "3"}, {"seed", "6"}}).all());
}

TEST(SimSource, FollowsWaypointsFromItsStart) {
  SimRun run(Options{{"duration", "20"},
                     {"noise", "off"},
                     {"start", "-2,1,90"},
                     {"waypoints", "0,1;0,-2"},
                     {"speed", "0.5"}});
  const std::vector<Pose2> poses = posesOf(run.all(), "groundTruth");
  ASSERT_GT(poses.size(), 100u);
  EXPECT_NEAR(poses.front().x, -2.0, 0.001);
  EXPECT_NEAR(poses.front().y, 1.0, 0.001);
  EXPECT_NEAR(poses.front().theta, 1.5708, 0.001);
  const auto nearCorner = [](const Pose2& pose) { return distance(pose, {0.0, 1.0, 0.0}) < 0.06; };
  EXPECT_TRUE(std::any_of(poses.begin(), poses.end(), nearCorner));
  EXPECT_LT(distance(poses.back(), {0.0, -2.0, 0.0}), 0.06);
}

TEST(SimSource, MeasuresTheWayExactlyWithoutNoise) {
  SimRun run(Options{{"duration", "30"}, {"noise", "off"}, {"start", "1,2,30"}});
  const std::vector<Message> messages = run.all();
  const std::vector<Pose2> truth = posesOf(messages, "groundTruth");
  const std::vector<Pose2> odometry = posesOf(messages, "odometry");
  ASSERT_EQ(truth.size(), odometry.size());
  for (std::size_t i = 0; i < truth.size(); ++i) {
    const Pose2 expected = truth.front() * odometry[i];
    // Words of 1 mm and 0.01 degrees, the latter over up to 16 m.
    EXPECT_LT(distance(expected, truth[i]), 0.005);
  }
}

TEST(SimSource, KidnapsOnDemand) {
  SimRun run(Options{{"duration", "4"}, {"kidnap", "1,3"}, {"speed", "0"}});
  const std::vector<Message> messages = run.all();
  const std::vector<Pose2> truth = posesOf(messages, "groundTruth");
  int jumps = 0;
  for (std::size_t i = 1; i < truth.size(); ++i) jumps += distance(truth[i - 1], truth[i]) > 0.1;
  EXPECT_EQ(jumps, 2);
  for (const Pose2& pose : posesOf(messages, "odometry")) EXPECT_LT(distance(pose, {}), 0.001);
}

TEST(SimSource, RefusesWrongOptionsByName) {
  const auto expectRefused = [](const std::string& key, const std::string& value,
                                const std::string& expected) {
    try {
      SimRun run(Options{{key, value}});
      FAIL() << key << "=" << value << " was accepted";
    } catch (const ConfigError& error) {
      const std::string message = error.what();
      EXPECT_NE(message.find(key), std::string::npos) << message;
      EXPECT_NE(message.find(expected), std::string::npos) << message;
    }
  };
  expectRefused("duration", "long", "\"long\"");
  expectRefused("duration", "-1", "[0, ");
  expectRefused("duration", "1e400", "1e400");
  expectRefused("duration", "nan", "nan");
  expectRefused("seed", "-1", "whole number");
  expectRefused("seed", "", "whole number");
  expectRefused("cycle_ms", "0", "[0.1, 1000]");
  expectRefused("start", "1,2", "x,y,theta");
  expectRefused("waypoints", "1,2;3", "\"3\"");
  expectRefused("noise", "maybe", "maybe");
  expectRefused("kidnap", "3,1", "rising");
  expectRefused("tempo", "1", "tempo");
}

// A scene says itself which robots drive where; whose readings are wanted can be said, else they
// are the first one's.
TEST(SimSource, OfASceneIsOneOfItsRobots) {
  const Options kick{{"path", ORTUNG_SOURCE_DIR "/maps/scenes/kick.toml"}, {"duration", "0.2"}};
  const auto startOf = [&](const std::string& robot) {
    Options options = kick;
    if (!robot.empty()) options["robot"] = robot;
    SimRun run(options, "");
    return posesOf(run.all(), "groundTruth").at(0);
  };
  EXPECT_NEAR(startOf("").x, -1.3, 0.1) << "the striker";
  EXPECT_NEAR(startOf("striker").x, -1.3, 0.1);
  EXPECT_NEAR(startOf("pusher").y, -3.1, 0.1);
  EXPECT_THROW(startOf("nobody"), std::exception);
  for (const auto& [key, value] :
       Options{{"start", "1,2,0"}, {"waypoints", "1,2;3,4"}, {"speed", "0.5"}, {"kidnap", "1,2"}}) {
    Options options = kick;
    options[key] = value;
    try {
      SimRun run(options, "");
      ADD_FAILURE() << key << " was taken";
    } catch (const ConfigError& error) {
      const std::string message = error.what();
      EXPECT_NE(message.find(key + " does not fit a scene"), std::string::npos) << message;
    }
  }
  EXPECT_THROW(SimRun(Options{{"robot", "pioneer"}}), ConfigError) << "of a world there is but one";
}

TEST(SimSource, NeedsARobotFileAndRoomAtTheStart) {
  EXPECT_THROW(SimRun(Options{}, ""), ConfigError);
  EXPECT_THROW(SimRun(Options{{"start", "100,0,0"}}), std::exception);
}

class RobotFileTest : public testing::TestWithParam<const char*> {};

TEST_P(RobotFileTest, RunsInTheSimulator) {
  SimRun run(Options{{"duration", "0.2"}},
             std::string(ORTUNG_SOURCE_DIR "/maps/robots/") + GetParam());
  EXPECT_GT(run.all().size(), 5u);
  EXPECT_NE(run.source->robotToml().find("[[sensor]]"), std::string::npos);
}

INSTANTIATE_TEST_SUITE_P(Shipped, RobotFileTest,
                         testing::Values("pioneer.toml", "pioneer_lrf.toml", "pioneer_posts.toml",
                                         "sonar_ring.toml", "laboratory.toml"));

}  // namespace
}  // namespace ortung

// Readings as messages: what MCL says, and the tree of frames.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstring>
#include <numbers>

#include "../support/Radar.hpp"
#include "ToldTopics.hpp"
#include "ortung/formats/ChangesData.hpp"
#include "ortung/formats/OdometryData.hpp"
#include "ortung/formats/PoseData.hpp"
#include "ortung/formats/PoseFixData.hpp"
#include "ortung/formats/ProtectionData.hpp"
#include "ortung/formats/TrackData.hpp"
#include "ortung/ros2/RobotTopics.hpp"

namespace ortung::ros2 {
namespace {

constexpr double kPi = std::numbers::pi;
const SensorId kOdometryId{"odometry", "odometry", "pose"};
const SensorId kTruthId{"reference", "groundTruth", "pose"};
const SensorId kPoseId{"mcl", "LOCALIZATION", "pose"};

class RobotTopicsTest : public ::testing::Test {
 protected:
  RobotTopicsTest() { container_.add(std::make_unique<OdometryData>(kOdometryId)); }

  static Message odometry(double x, double y, double theta) {
    OdometryData::Reading state;
    state.pose = {x, y, theta};
    return {0, kOdometryId, OdometryData::encode(state)};
  }
  static Message estimate(const Pose2& pose) {
    const PoseFixData::Fix fix{pose, {0.04, 0.01, 0.002, 0.01, 0.09, 0.003, 0.002, 0.003, 0.01}};
    return {0, kPoseId, PoseFixData::encode({&fix, 1})};
  }
  /// Where odometry's frame lies in the map.
  static Pose2 inMap(const std::string& tf) {
    for (const TransformStamped& one : read<TfMessage>(tf).transforms)
      if (one.childFrame == "odom" && one.header.frame == "map") return toPose2(one.transform);
    return {std::nan(""), 0, 0};
  }

  SensorContainer container_;
};

TEST_F(RobotTopicsTest, AnEstimateHasItsCovarianceInTheRowsOfXYAndHeading) {
  RobotTopics topics(container_, {});
  auto found = told(topics, {estimate({1.5, -2.0, kPi / 2})});
  const auto pose = read<PoseWithCovarianceStamped>(found["/pose"]);
  EXPECT_EQ(pose.header.frame, "map");
  EXPECT_NEAR(pose.pose.position.x, 1.5, 1e-9);
  EXPECT_NEAR(pose.pose.orientation.z, std::sqrt(0.5), 1e-4);
  EXPECT_NEAR(pose.covariance[0], 0.04, 1e-6);   // x, x
  EXPECT_NEAR(pose.covariance[1], 0.01, 1e-5);   // x, y
  EXPECT_NEAR(pose.covariance[7], 0.09, 1e-6);   // y, y
  EXPECT_NEAR(pose.covariance[5], 0.002, 1e-5);  // x, heading
  EXPECT_NEAR(pose.covariance[35], 0.01, 1e-6);  // heading, heading
  EXPECT_EQ(pose.covariance[14], 0.0);           // z, z
}

std::string valueOf(const DiagnosticArray::Status& status, const std::string& key) {
  for (const auto& [name, value] : status.values)
    if (name == key) return value;
  return "none";
}

TEST_F(RobotTopicsTest, HowFarMclCanBeReliedOnIsADiagnosis) {
  RobotTopics topics(container_, {.robot = "tim"});
  const auto status = [&](TrackStatus how, TrackReason why) {
    const TrackData::Reading track{how, why, 0.75, 0.5, 3, Relocalization::kOtherPlace};
    auto found =
        told(topics, {TrackData::message(0, track), ProtectionData::message(0, {0.25, kPi / 180})});
    EXPECT_EQ(read<Words>(found["/tim/ortung/mcl/LOCALIZATION/status"]).data,
              TrackData::encode(track))
        << "its words go out, too";
    const auto array = read<DiagnosticArray>(found["/diagnostics"]);
    EXPECT_EQ(array.status.size(), 1U);
    return array.status.at(0);
  };
  const auto good = status(TrackStatus::kTracking, TrackReason::kFits);
  EXPECT_EQ(good.level, DiagnosticArray::Status::kOk);
  EXPECT_EQ(good.name, "tim: localization");
  EXPECT_EQ(good.message, "tracking: readings fit");
  EXPECT_EQ(valueOf(good, "quality"), "0.75");
  EXPECT_EQ(valueOf(good, "protection_m"), "0.25");
  EXPECT_EQ(valueOf(good, "protection_deg"), "1");
  EXPECT_EQ(valueOf(good, "relocalizations"), "3");
  EXPECT_EQ(valueOf(good, "relocalization"), "readings fit another place better");
  EXPECT_EQ(status(TrackStatus::kUncertain, TrackReason::kLate).level,
            DiagnosticArray::Status::kWarn);
  EXPECT_EQ(status(TrackStatus::kLost, TrackReason::kSpread).level,
            DiagnosticArray::Status::kError);
  EXPECT_TRUE(told(topics, {odometry(1, 0, 0)})["/diagnostics"].empty()) << "told once";
  auto open = told(topics, {TrackData::message(0, {}), ProtectionData::message(0, {})});
  EXPECT_EQ(valueOf(read<DiagnosticArray>(open["/diagnostics"]).status.at(0), "protection_m"),
            "inf");
  EXPECT_THROW(told(topics, {{0, {"mcl", "LOCALIZATION", "status"}, {9, 9, 9, 9}}}),
               std::invalid_argument);
}

TEST_F(RobotTopicsTest, TheSmoothPoseIsInTheMap) {
  RobotTopics topics(container_, {});
  auto found = told(
      topics, {{0, {"mcl", "LOCALIZATION", "smooth"}, PoseData::encode({1.5, -2.0, kPi / 2})}});
  const auto pose = read<PoseStamped>(found["/smooth_pose"]);
  EXPECT_EQ(pose.header.frame, "map");
  EXPECT_NEAR(toPose2(pose.pose).x, 1.5, 1e-9);
  EXPECT_NEAR(toPose2(pose.pose).theta, kPi / 2, 1e-4);
  EXPECT_FALSE(found["/ortung/mcl/LOCALIZATION/smooth"].empty());
}

TEST_F(RobotTopicsTest, WhereTheMapNoLongerFitsIsAGridOfItsOwn) {
  RobotTopics topics(container_, {});
  const auto gridOf = [&](const std::vector<ChangesData::Cell>& cells) {
    auto found = told(topics, {ChangesData::message(0, {0.1, cells})});
    EXPECT_FALSE(found["/ortung/mcl/LOCALIZATION/map"].empty());
    return read<OccupancyGrid>(found["/map_changes"]);
  };
  const OccupancyGrid grid = gridOf({{false, true, 1.02, -0.98, 2, 0},
                                     {true, true, 1.25, -0.75, 3, 1},
                                     {true, false, 7.0, 7.0, 1, 0}});
  EXPECT_EQ(grid.header.frame, "map");
  EXPECT_FLOAT_EQ(grid.resolution, 0.1F);
  EXPECT_NEAR(grid.origin.position.x, 1.0, 1e-9);
  EXPECT_NEAR(grid.origin.position.y, -1.0, 1e-9);
  ASSERT_EQ(grid.width, 3U);
  ASSERT_EQ(grid.height, 3U);
  EXPECT_EQ(grid.data, (std::vector<std::int8_t>{0, -1, -1, -1, -1, -1, -1, -1, 100}));
  EXPECT_EQ(gridOf({}).data, (std::vector<std::int8_t>{-1})) << "viewers want a cell";
  const std::vector<ChangesData::Cell> apart{{true, true, -1e4, 0.0, 2, 0},
                                             {true, true, 1e4, 1e4, 2, 0}};
  EXPECT_TRUE(told(topics, {ChangesData::message(0, {0.1, apart})})["/map_changes"].empty())
      << "too far apart";
  EXPECT_FALSE(told(topics, {ChangesData::message(0, {0.1, {}})})["/map_changes"].empty());
  EXPECT_TRUE(told(topics, {ChangesData::message(1, {0.1, {}})})["/map_changes"].empty())
      << "the same again";
}

TEST_F(RobotTopicsTest, SamplesArePosesInTheMap) {
  RobotTopics topics(container_, {});
  constexpr std::uint32_t kZero = 1U << 31;
  auto found = told(topics, {{0,
                              {"mcl", "LOCALIZATION", "samples"},
                              {kZero + 1500, kZero - 250, 27000, 65535, kZero, kZero, 0, 1}}});
  const auto cloud = read<PoseArray>(found["/particle_cloud"]);
  ASSERT_EQ(cloud.poses.size(), 2u);
  const Pose2 first = toPose2(cloud.poses[0]);
  EXPECT_NEAR(first.x, 1.5, 1e-9);
  EXPECT_NEAR(first.y, -0.25, 1e-9);
  EXPECT_NEAR(first.theta, -kPi / 2, 1e-9);  // 270 degrees, counted from 0
  EXPECT_NEAR(toPose2(cloud.poses[1]).theta, 0.0, 1e-9);
  EXPECT_THROW(told(topics, {{0, {"mcl", "LOCALIZATION", "samples"}, {1, 2, 3}}}),
               std::invalid_argument);
}

TEST_F(RobotTopicsTest, TheMapsFrameFollowsTheTruthUntilThereIsAnEstimate) {
  RobotTopics topics(container_, {});
  // The robot is at (2, 1) looking left; odometry believes (1, 0) looking ahead.
  auto found = told(topics, {odometry(1, 0, 0), {0, kTruthId, PoseData::encode({2, 1, kPi / 2})}});
  Pose2 frame = inMap(found["/tf"]);
  EXPECT_NEAR(frame.x, 2.0, 1e-9);
  EXPECT_NEAR(frame.y, 0.0, 1e-9);
  EXPECT_NEAR(frame.theta, kPi / 2, 1e-9);
  found = told(topics, {odometry(1, 0, 0), estimate({5, 5, 0})});
  frame = inMap(found["/tf"]);
  EXPECT_NEAR(frame.x, 4.0, 1e-9);
  EXPECT_NEAR(frame.y, 5.0, 1e-9);
  found = told(topics, {odometry(1, 0, 0), {0, kTruthId, PoseData::encode({2, 1, 0})}});
  EXPECT_TRUE(std::isnan(inMap(found["/tf"]).x));
}

TEST_F(RobotTopicsTest, TheMapsFrameCanBeLeftToOthers) {
  RobotTopics topics(container_, {.mapFrame = RobotTopics::MapFrame::kNone});
  auto found = told(topics, {odometry(1, 0, 0), {0, kTruthId, PoseData::encode({2, 1, 0})}});
  const auto tf = read<TfMessage>(found["/tf"]);
  ASSERT_EQ(tf.transforms.size(), 1u);
  EXPECT_EQ(tf.transforms[0].childFrame, "base_link");
}

TEST_F(RobotTopicsTest, APluginsOwnFormatGoesOutAsPoints) {
  const SensorId id{"acme", "radar", "echoes"};
  container_.add(std::make_unique<test::RadarData>(id, Pose2{0.5, 0.0, 0.0}));
  RobotTopics topics(container_, {});
  std::vector<std::uint32_t> words = test::RadarData::encode(2.0, kPi / 2);
  for (const std::uint32_t word : test::RadarData::encode(1.0, 0.0)) words.push_back(word);
  auto found = told(topics, {{0, id, words}});
  const auto cloud = read<PointCloud>(found["/points"]);
  EXPECT_EQ(cloud.header.frame, "acme_echoes");
  EXPECT_EQ(cloud.width, 2u);
  std::vector<std::string> names;
  for (const PointCloud::Field& field : cloud.fields) names.push_back(field.name);
  EXPECT_EQ(names, (std::vector<std::string>{"x", "y", "z", "range", "bearing"}));
  ASSERT_EQ(cloud.pointStep, 20u);
  ASSERT_EQ(cloud.data.size(), 40u);
  std::array<float, 10> values{};
  std::memcpy(values.data(), cloud.data.data(), cloud.data.size());
  const std::array<double, 10> expected = {0.0, 2.0, 0.0, 2.0, kPi / 2, 1.0, 0.0, 0.0, 1.0, 0.0};
  for (std::size_t i = 0; i < values.size(); ++i)
    EXPECT_NEAR(static_cast<double>(values.at(i)), expected.at(i), 1e-6) << i;
  // Its words go out, too, so that they come back from a file.
  EXPECT_EQ(read<Words>(found["/ortung/acme/radar/echoes"]).data, words);
  EXPECT_EQ(schemaText(PointCloud::kType).find("std_msgs/Header header"), 0u);
  EXPECT_THROW(told(topics, {{0, id, {1}}}), std::invalid_argument);
}

TEST_F(RobotTopicsTest, StampsThatRosDoesNotHaveAreRefused) {
  RobotTopics topics(container_, {});
  for (const Timestamp stamp : {Timestamp{-1}, Timestamp{1} << 52}) {
    Message message = odometry(0, 0, 0);
    message.stamp = stamp;
    EXPECT_THROW(told(topics, {message}), std::invalid_argument) << stamp;
  }
}

}  // namespace
}  // namespace ortung::ros2

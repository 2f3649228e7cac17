// Features of a robot file that messages of ROS 2 fill as they are.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "LiveFeatures.hpp"
#include "LiveReadings.hpp"
#include "ortung/formats/ConeData.hpp"
#include "ortung/formats/OdometryData.hpp"
#include "ortung/formats/PoseFixData.hpp"
#include "ortung/ros2/RobotTopics.hpp"

namespace ortung::ros2 {
namespace {

constexpr std::int64_t kStamp = 1'000'000'000'000;  // [ns]
const SensorId kSonar{"front", "sonar", "range"};
const SensorId kFix{"marker", "fix", "pose"};

class LiveFeaturesTest : public testing::Test {
 protected:
  LiveFeaturesTest() {
    container_.add(std::make_unique<ConeData>(kSonar, Pose2{}, ConeData::Config{}));
    container_.add(std::make_unique<PoseFixData>(kFix, PoseFixData::Config{}));
    container_.add(std::make_unique<OdometryData>(SensorId{"odometry", "odometry", "pose"}));
  }
  double range(float range, float least = 0.1F, float most = 4.0F) {
    Range told;
    told.header = {kStamp + 999, "sonar"};
    told.minRange = least;
    told.maxRange = most;
    told.range = range;
    const Message message = sonar().read(toCdr(told));
    EXPECT_EQ(message.stamp, kStamp / 1000);
    EXPECT_EQ(message.id, kSonar);
    ConeData data(kSonar, {}, {});
    data.setData(message.stamp, message.words);
    return data.reading();
  }
  LiveFeature sonar() const { return liveFeatureOf(container_, "s=front/sonar/range", "map"); }
  static PoseWithCovarianceStamped fix(const std::string& frame = "map", double variance = 0.04) {
    PoseWithCovarianceStamped told;
    told.header = {kStamp, frame};
    told.pose = fromPose2({1.0, -2.0, 0.5});
    for (const std::size_t i : {0, 7, 35}) told.covariance[i] = variance;
    return told;
  }
  SensorContainer container_;
};

TEST_F(LiveFeaturesTest, TakeRangesByTheirLimits) {
  EXPECT_NEAR(range(1.234F), 1.234, 1e-3);
  EXPECT_TRUE(std::isinf(range(3.5F))) << "beyond the feature's greatest range of 3 m";
  EXPECT_TRUE(std::isinf(range(std::numeric_limits<float>::infinity())));
  EXPECT_TRUE(std::isinf(range(2.0F, 0.1F, 2.0F))) << "at the message's own greatest range";
  EXPECT_TRUE(std::isnan(range(0.05F))) << "too near";
  EXPECT_TRUE(std::isnan(range(-std::numeric_limits<float>::infinity())));
  EXPECT_TRUE(std::isnan(range(std::numeric_limits<float>::quiet_NaN())));
}

TEST_F(LiveFeaturesTest, TakePosesInTheMap) {
  const LiveFeature feature = liveFeatureOf(container_, "/markers=marker/fix/pose", "map");
  EXPECT_EQ(feature.topic, "/markers");
  EXPECT_EQ(feature.type, PoseWithCovarianceStamped::kType);
  PoseFixData data(kFix, {});
  data.setData(1, feature.read(toCdr(fix())).words);
  ASSERT_EQ(data.reading().size(), 1U);
  EXPECT_NEAR(data.reading()[0].pose.x, 1.0, 1e-3);
  EXPECT_NEAR(data.reading()[0].pose.theta, 0.5, 1e-3);
  EXPECT_NEAR(data.reading()[0].covariance[0], 0.04, 1e-4);
  EXPECT_THROW(feature.read(toCdr(fix("odom"))), std::invalid_argument);
  EXPECT_THROW(feature.read(toCdr(fix("map", -1.0))), std::invalid_argument);
  EXPECT_THROW(feature.read(toCdr(fix("map", std::nan("")))), std::invalid_argument);
  EXPECT_THROW(feature.read("\0\1\0\0"), std::invalid_argument);
}

TEST_F(LiveFeaturesTest, AreThoseOfTheRobotFile) {
  const auto why = [&](const std::string& text) -> std::string {
    try {
      liveFeatureOf(container_, text, "map");
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(why("s=front/sonar/range"), "");
  EXPECT_NE(why("s").find("TOPIC=MODEL/TYPE/FEATURE"), std::string::npos);
  EXPECT_NE(why("s=back/sonar/range").find("no feature of that name"), std::string::npos);
  EXPECT_NE(why("s=odometry/odometry/pose").find("expected cone or fix"), std::string::npos);
}

TEST_F(LiveFeaturesTest, ComeWithOdometryOfTheirTime) {
  LiveReadings::Options options;
  options.features = {sonar()};
  options.odometry = {"odometry", "odometry", "pose"};
  options.base = "base_link";
  LiveReadings readings(options);
  Range told;
  told.header = {kStamp, "sonar"};
  told.maxRange = 4.0F;
  told.range = 1.0F;
  readings.takeFeature(0, toCdr(told));
  readings.takeFeature(0, "");
  Odometry moved;
  moved.header = {kStamp, "odom"};
  moved.childFrame = "base_link";
  readings.takeOdometry(toCdr(moved));
  const auto moment = readings.next(std::chrono::milliseconds(0));
  ASSERT_TRUE(moment);
  EXPECT_EQ(moment->readings.size(), 2U);
  EXPECT_EQ(readings.leftOut().size(), 1U);
}

}  // namespace
}  // namespace ortung::ros2

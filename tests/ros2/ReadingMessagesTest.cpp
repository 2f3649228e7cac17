/// Readings of each kind of sensor as messages: units, marks of invalid ranges, frames, names.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>

#include "ToldTopics.hpp"
#include "ortung/camera/ImageData.hpp"
#include "ortung/formats/ConeData.hpp"
#include "ortung/formats/OdometryData.hpp"
#include "ortung/formats/PoseData.hpp"
#include "ortung/formats/PoseFixData.hpp"
#include "ortung/formats/ScanData.hpp"
#include "ortung/ros2/RobotTopics.hpp"

namespace ortung::ros2 {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr std::uint32_t kZero = 1U << 31;  // of words with a sign
const SensorId kLaser{"front-laser", "LRF", "scan"};
const SensorId kRear{"2nd", "LRF", "scan"};
const SensorId kSonar{"sonar", "ultrasonic", "s0"};
const SensorId kWheels{"odometry", "odometry", "pose"};
const SensorId kSecondWheels{"visual", "odometry", "pose"};
const SensorId kCamera{"cam", "camera", "image"};
const SensorId kTruth{"reference", "groundTruth", "pose"};

class ReadingMessages : public ::testing::Test {
 protected:
  void addScan(const SensorId& id, const Pose2& mount) {
    ScanData::Config config;
    config.beams = 4;
    config.firstAngle = -0.75;
    config.angleStep = 0.5;
    config.minRange = 0.25;
    config.maxRange = 8.0;
    container_.add(std::make_unique<ScanData>(id, mount, config));
  }
  static std::vector<std::string> namesOf(const RobotTopics& topics) {
    std::vector<std::string> names;
    for (const Topic& topic : topics.topics()) names.push_back(topic.name);
    return names;
  }
  SensorContainer container_;
};

TEST_F(ReadingMessages, AScanHasItsBeamsRangesAndTime) {
  addScan(kLaser, {});
  RobotTopics topics(container_, {});
  auto found = told(topics, {{1'234'567, kLaser, {1500, 0, 7999, 8000}}});
  const auto scan = read<LaserScan>(found.at("/scan"));
  EXPECT_EQ(scan.header.stamp, 1'234'567'000);
  EXPECT_EQ(scan.header.frame, "front_laser_scan");
  EXPECT_FLOAT_EQ(scan.angleMin, -0.75F);
  EXPECT_FLOAT_EQ(scan.angleMax, 0.75F);
  EXPECT_FLOAT_EQ(scan.angleIncrement, 0.5F);
  EXPECT_FLOAT_EQ(scan.rangeMin, 0.25F);
  EXPECT_FLOAT_EQ(scan.rangeMax, 8.0F);
  ASSERT_EQ(scan.ranges.size(), 4u);
  EXPECT_FLOAT_EQ(scan.ranges[0], 1.5F);
  EXPECT_TRUE(std::isnan(scan.ranges[1]));
  EXPECT_FLOAT_EQ(scan.ranges[2], 7.999F);
  EXPECT_TRUE(std::isinf(scan.ranges[3])) << "the greatest range: nothing seen";
}

TEST_F(ReadingMessages, ASonarHasItsConeAndRange) {
  ConeData::Config config;
  config.openingAngle = 0.5;
  config.maxRange = 3.0;
  container_.add(std::make_unique<ConeData>(kSonar, Pose2{0.25, 0, 1.0}, config));
  RobotTopics topics(container_, {});
  for (const auto& [word, range] : {std::pair{1250U, 1.25F}, {2999U, 2.999F}}) {
    const auto message = read<Range>(told(topics, {{5, kSonar, {word}}}).at("/range/sonar/s0"));
    EXPECT_EQ(message.header.frame, "sonar_s0");
    EXPECT_EQ(message.radiationType, 0) << "sound";
    EXPECT_NEAR(message.fieldOfView, 0.5, 1e-6);
    EXPECT_FLOAT_EQ(message.maxRange, 3.0F);
    EXPECT_FLOAT_EQ(message.range, range);
  }
  EXPECT_TRUE(
      std::isinf(read<Range>(told(topics, {{5, kSonar, {3000}}}).at("/range/sonar/s0")).range));
  EXPECT_TRUE(
      std::isnan(read<Range>(told(topics, {{5, kSonar, {0}}}).at("/range/sonar/s0")).range));
}

TEST_F(ReadingMessages, OdometryHasPoseAndVelocitiesOfTheRobot) {
  container_.add(std::make_unique<OdometryData>(kWheels));
  RobotTopics topics(container_, {});
  OdometryData::Reading state;
  state.pose = {1.5, -2.5, -kPi / 2};
  state.translationalVelocity = 0.5;
  state.lateralVelocity = -0.125;
  state.rotationalVelocity = kPi / 4;
  auto found = told(topics, {{7, kWheels, OdometryData::encode(state)}});
  const auto odometry = read<Odometry>(found.at("/odom"));
  EXPECT_EQ(odometry.header.frame, "odom");
  EXPECT_EQ(odometry.childFrame, "base_link");
  EXPECT_NEAR(odometry.pose.position.x, 1.5, 1e-9);
  EXPECT_NEAR(odometry.pose.position.y, -2.5, 1e-9);
  EXPECT_NEAR(odometry.pose.orientation.z, -std::sqrt(0.5), 1e-9);
  EXPECT_NEAR(odometry.pose.orientation.w, std::sqrt(0.5), 1e-9);
  EXPECT_NEAR(odometry.linear.x, 0.5, 1e-9);
  EXPECT_NEAR(odometry.linear.y, -0.125, 1e-9);
  EXPECT_NEAR(odometry.angular.z, kPi / 4, 1e-9);
  EXPECT_EQ(found.size(), 2u) << "the pose at /odom and /tf, but no words";
  // Motion data have no place in that message: they go out as words, too.
  state.motionData = {7, 8};
  found = told(topics, {{8, kWheels, OdometryData::encode(state)}});
  EXPECT_EQ(read<Words>(found.at("/ortung/odometry/odometry/pose")).data,
            OdometryData::encode(state));
}

TEST_F(ReadingMessages, PicturesAreRowsOfTheirPixels) {
  container_.add(std::make_unique<ImageData>(kCamera, Pose2{}));
  RobotTopics topics(container_, {});
  const std::vector<std::uint8_t> rgb{1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12};
  auto found =
      told(topics, {{9, kCamera, ImageData::encode({{2, 2}, PixelFormat::kRgb, rgb.data()})}});
  auto image = read<Image>(found.at("/image"));
  EXPECT_EQ(image.encoding, "rgb8");
  EXPECT_EQ(image.width, 2u);
  EXPECT_EQ(image.height, 2u);
  EXPECT_EQ(image.step, 6u);
  EXPECT_EQ(image.data, rgb);
  found = told(topics, {{9, kCamera, ImageData::encode({{4, 1}, PixelFormat::kGrey, rgb.data()})}});
  image = read<Image>(found.at("/image"));
  EXPECT_EQ(image.encoding, "mono8");
  EXPECT_EQ(image.step, 4u);
  EXPECT_EQ(image.data, std::vector<std::uint8_t>(rgb.begin(), rgb.begin() + 4));
}

// Two scanners share no topic, and names of ROS have no dashes and no digit in front.
TEST_F(ReadingMessages, NamesAreThoseThatRosAllows) {
  addScan(kLaser, {});
  addScan(kRear, {});
  container_.add(std::make_unique<OdometryData>(kWheels));
  container_.add(std::make_unique<OdometryData>(kSecondWheels));
  const RobotTopics topics(container_, {});
  EXPECT_EQ(namesOf(topics),
            (std::vector<std::string>{"/tf_static", "/map", "/tf", "/scan/front_laser/scan",
                                      "/scan/n2nd/scan", "/odom", "/odom/visual/pose",
                                      "/ground_truth", "/pose", "/smooth_pose", "/diagnostics",
                                      "/map_changes", "/particle_cloud"}));
  const auto& all = topics.topics();
  EXPECT_TRUE(all[0].isLatched);
  EXPECT_TRUE(all[1].isLatched);
  EXPECT_FALSE(all[2].isLatched);
  EXPECT_EQ(all[3].feature, "front-laser/LRF/scan");
  EXPECT_TRUE(all[3].format.starts_with("scan beams=4 ")) << all[3].format;
  EXPECT_EQ(all[5].type, "nav_msgs/msg/Odometry");
}

TEST_F(ReadingMessages, ARobotsNameStandsBeforeWhatIsItsOwn) {
  addScan(kLaser, {0.5, 0, 0});
  container_.add(std::make_unique<OdometryData>(kWheels));
  RobotTopics topics(container_, {.robot = "my robot"});
  EXPECT_EQ(namesOf(topics),
            (std::vector<std::string>{"/tf_static", "/map", "/tf", "/my_robot/scan",
                                      "/my_robot/odom", "/my_robot/ground_truth", "/my_robot/pose",
                                      "/my_robot/smooth_pose", "/diagnostics",
                                      "/my_robot/map_changes", "/my_robot/particle_cloud"}));
  auto found = told(topics, {{0, kWheels, OdometryData::encode({})}});
  const auto odometry = read<Odometry>(found.at("/my_robot/odom"));
  EXPECT_EQ(odometry.header.frame, "my_robot/odom");
  EXPECT_EQ(odometry.childFrame, "my_robot/base_link");
}

// Where sensors sit is told once, with the stamp of the beginning; odometry sits nowhere.
TEST_F(ReadingMessages, MountsAreTheStaticTransforms) {
  addScan(kLaser, {0.5, -0.25, kPi / 2});
  container_.add(std::make_unique<OdometryData>(kWheels));
  const RobotTopics topics(container_, {});
  std::string cdr;
  topics.start(3, [&](std::size_t topic, Timestamp stamp, std::string_view bytes) {
    EXPECT_EQ(topics.topics()[topic].name, "/tf_static");
    EXPECT_EQ(stamp, 3);
    cdr = bytes;
  });
  const auto tf = read<TfMessage>(cdr);
  ASSERT_EQ(tf.transforms.size(), 1u);
  EXPECT_EQ(tf.transforms[0].header.stamp, 3000);
  EXPECT_EQ(tf.transforms[0].header.frame, "base_link");
  EXPECT_EQ(tf.transforms[0].childFrame, "front_laser_scan");
  const Pose2 mount = toPose2(tf.transforms[0].transform);
  EXPECT_NEAR(mount.x, 0.5, 1e-12);
  EXPECT_NEAR(mount.y, -0.25, 1e-12);
  EXPECT_NEAR(mount.theta, kPi / 2, 1e-12);
}

TEST_F(ReadingMessages, AMapGetsTheFrameAndTimeOfItsShowing) {
  const RobotTopics topics(container_, {});
  OccupancyGrid map;
  map.header.frame = "elsewhere";
  map.data = {100};
  topics.show(map, 2, [&](std::size_t topic, Timestamp, std::string_view bytes) {
    EXPECT_EQ(topics.topics()[topic].name, "/map");
    const auto shown = read<OccupancyGrid>(std::string(bytes));
    EXPECT_EQ(shown.header.frame, "map");
    EXPECT_EQ(shown.header.stamp, 2000);
    EXPECT_EQ(shown.mapLoadTime, 2000);
    EXPECT_EQ(shown.data, std::vector<std::int8_t>{100});
  });
}

// Without odometry the robot itself is put into the map.
TEST_F(ReadingMessages, TruthWithoutOdometryMovesTheRobot) {
  RobotTopics topics(container_, {});
  auto found = told(topics, {{1, kTruth, PoseData::encode({2, 3, 0})}});
  const auto tf = read<TfMessage>(found.at("/tf"));
  ASSERT_EQ(tf.transforms.size(), 1u);
  EXPECT_EQ(tf.transforms[0].header.frame, "map");
  EXPECT_EQ(tf.transforms[0].childFrame, "base_link");
  EXPECT_NEAR(tf.transforms[0].transform.position.y, 3.0, 1e-9);
  const auto pose = read<PoseStamped>(found.at("/ground_truth"));
  EXPECT_EQ(pose.header.frame, "map");
  EXPECT_NEAR(pose.pose.position.x, 2.0, 1e-9);
}

// With odometry that has not come yet nothing can be said of its frame.
TEST_F(ReadingMessages, NothingIsToldOfAnOdometryThatHasNotCome) {
  container_.add(std::make_unique<OdometryData>(kWheels));
  RobotTopics topics(container_, {});
  EXPECT_FALSE(told(topics, {{1, kTruth, PoseData::encode({2, 3, 0})}}).contains("/tf"));
}

TEST_F(ReadingMessages, EachTopicKnowsItsFeatures) {
  addScan(kLaser, {});
  container_.add(std::make_unique<OdometryData>(kWheels));
  RobotTopics topics(container_, {});
  topics.addWords({"x", "y", "z"});
  topics.addWords({"x", "y", "z"});  // once is enough
  std::map<std::string, std::vector<std::string>> features;
  for (std::size_t i = 0; i < topics.topics().size(); ++i)
    features[topics.topics()[i].name] = topics.featuresOf(i);
  using Texts = std::vector<std::string>;
  EXPECT_EQ(features.size(), topics.topics().size());
  EXPECT_EQ(features["/scan"], Texts{"front-laser/LRF/scan"});
  EXPECT_EQ(features["/ground_truth"], Texts{"*/groundTruth/*"});
  EXPECT_EQ(features["/particle_cloud"], Texts{"mcl/LOCALIZATION/samples"});
  EXPECT_EQ(features["/pose"], Texts{"mcl/LOCALIZATION/pose"});
  EXPECT_EQ(features["/tf"],
            (Texts{"*/groundTruth/*", "mcl/LOCALIZATION/pose", "odometry/odometry/pose"}));
  EXPECT_EQ(features["/map"], Texts{});
  EXPECT_EQ(features["/ortung/x/y/z"], Texts{"x/y/z"});
}

TEST_F(ReadingMessages, AnEmptyFixIsNoMessage) {
  const SensorId gps{"gps", "GPS", "fix"};
  container_.add(std::make_unique<PoseFixData>(gps, PoseFixData::Config{}));
  RobotTopics topics(container_, {});
  EXPECT_TRUE(told(topics, {{0, gps, {}}}).empty());
  const PoseFixData::Fix fix{{1, 2, 0}, {0.25, 0, 0, 0, 0.09, 0, 0, 0, 0.01}};
  const auto pose = read<PoseWithCovarianceStamped>(
      told(topics, {{0, gps, PoseFixData::encode({&fix, 1})}}).at("/pose_fix"));
  EXPECT_EQ(pose.header.frame, "map") << "a fix is a place in the field, wherever the sensor sits";
  EXPECT_NEAR(pose.covariance[0], 0.25, 1e-6);
  EXPECT_NEAR(pose.covariance[7], 0.09, 1e-6);
}

// A pose in space is looked at from above: rolled and pitched, the heading is that of its x axis.
TEST(PlanarPoses, AreThePosesFromAbove) {
  const double a = std::sin(0.15), b = std::cos(0.15);
  const Pose2 pitched = toPose2({{1, 2, 3}, {0, a, 0, b}});  // 0.3 rad about y
  EXPECT_EQ(pitched.x, 1.0);
  EXPECT_EQ(pitched.y, 2.0);
  EXPECT_NEAR(pitched.theta, 0.0, 1e-12);
  EXPECT_NEAR(toPose2({{0, 0, 0}, {a, 0, 0, b}}).theta, 0.0, 1e-12);
  // A third of a turn to the left, then pitched by 0.3 rad: products of quaternions by hand.
  const double s = std::sin(kPi / 3), c = std::cos(kPi / 3);
  EXPECT_NEAR(toPose2({{0, 0, 0}, {-s * a, c * a, s * b, c * b}}).theta, 2 * kPi / 3, 1e-12);
  EXPECT_NEAR(toPose2({{0, 0, 0}, {0, 0, 5 * s, 5 * c}}).theta, 2 * kPi / 3, 1e-12);
  EXPECT_TRUE(std::isnan(toPose2({{0, 0, 0}, {0, 0, 0, 0}}).theta));
  EXPECT_TRUE(std::isnan(toPose2({{0, 0, 0}, {0, std::nan(""), 0, 1}}).theta));
}

TEST(PlanarPoses, ComeBackFromSpace) {
  for (double theta = -3.0; theta <= 3.0; theta += 0.5) {
    const Pose pose = fromPose2({1.5, -0.5, theta});
    EXPECT_EQ(pose.position.z, 0.0);
    EXPECT_NEAR(std::hypot(pose.orientation.z, pose.orientation.w), 1.0, 1e-12);
    EXPECT_NEAR(toPose2(pose).theta, theta, 1e-12);
  }
}

}  // namespace
}  // namespace ortung::ros2

// Features of a robot file that messages of ROS 2 fill as they are.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <vector>

#include "LiveFeatures.hpp"
#include "LiveImages.hpp"
#include "LiveReadings.hpp"
#include "ortung/camera/ImageData.hpp"
#include "ortung/formats/ConeData.hpp"
#include "ortung/formats/OdometryData.hpp"
#include "ortung/formats/PoseFixData.hpp"
#include "ortung/ros2/RobotTopics.hpp"

namespace ortung::ros2 {
namespace {

constexpr std::int64_t kStamp = 1'000'000'000'000;  // [ns]
const SensorId kSonar{"front", "sonar", "range"};
const SensorId kFix{"marker", "fix", "pose"};
const SensorId kCamera{"camera", "image", "raw"};

class LiveFeaturesTest : public testing::Test {
 protected:
  LiveFeaturesTest() {
    container_.add(std::make_unique<ConeData>(kSonar, Pose2{}, ConeData::Config{}));
    container_.add(std::make_unique<PoseFixData>(kFix, PoseFixData::Config{}));
    container_.add(std::make_unique<ImageData>(kCamera, Pose2{}));
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

TEST_F(LiveFeaturesTest, TakePosesOnAFloor) {
  const auto onFirst = [](const Pose2& pose) { return Pose2{pose.x + 30.0, pose.y, pose.theta}; };
  const LiveFeature feature = liveFeatureOf(container_, "m=marker/fix/pose", "map", onFirst);
  PoseFixData data(kFix, {});
  data.setData(1, feature.read(toCdr(fix())).words);
  ASSERT_EQ(data.reading().size(), 1U);
  EXPECT_NEAR(data.reading()[0].pose.x, 31.0, 1e-3);
  EXPECT_NEAR(data.reading()[0].pose.y, -2.0, 1e-3);
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
  EXPECT_NE(why("s=odometry/odometry/pose").find("expected cone, fix or image"), std::string::npos);
}

/// Two rows of three pixels, each row followed by two bytes that are none of them.
Image picture(const std::string& encoding, std::size_t bytes) {
  Image image;
  image.header = {kStamp + 1000, "camera"};
  image.height = 2;
  image.width = 3;
  image.encoding = encoding;
  image.step = static_cast<std::uint32_t>(3 * bytes + 2);
  for (std::size_t i = 0; i < 2 * std::size_t{image.step}; ++i)
    image.data.push_back(static_cast<std::uint8_t>(i));
  return image;
}

/// Red, green and blue of the pixel in the middle of the second row.
std::vector<int> middleOf(const LiveFeature& feature, const Image& image) {
  const Message message = feature.read(toCdr(image));
  EXPECT_EQ(message.stamp, kStamp / 1000 + 1);
  ImageData data(kCamera, {});
  data.setData(message.stamp, message.words);
  const ImageView view = data.reading();
  EXPECT_EQ(view.size.width, 3);
  EXPECT_EQ(view.size.height, 2);
  std::vector<int> pixel;
  for (int c = 0; c < view.channels(); ++c) pixel.push_back(view.pixels[4 * view.channels() + c]);
  return pixel;
}

TEST_F(LiveFeaturesTest, TakePicturesOfEachEncoding) {
  const LiveFeature feature = liveFeatureOf(container_, "/image=camera/image/raw", "map");
  EXPECT_EQ(feature.type, Image::kType);
  EXPECT_EQ(middleOf(feature, picture("rgb8", 3)), (std::vector{14, 15, 16}));
  EXPECT_EQ(middleOf(feature, picture("bgr8", 3)), (std::vector{16, 15, 14}));
  EXPECT_EQ(middleOf(feature, picture("8UC3", 3)), (std::vector{16, 15, 14}));
  EXPECT_EQ(middleOf(feature, picture("rgba8", 4)), (std::vector{18, 19, 20}));
  EXPECT_EQ(middleOf(feature, picture("bgra8", 4)), (std::vector{20, 19, 18}));
  EXPECT_EQ(middleOf(feature, picture("mono8", 1)), (std::vector{6}));
}

TEST_F(LiveFeaturesTest, PicturesThatAreNoneAreRefused) {
  const LiveFeature feature = liveFeatureOf(container_, "/image=camera/image/raw", "map");
  const auto why = [&](const std::function<void(Image&)>& change) -> std::string {
    Image image = picture("rgb8", 3);
    change(image);
    try {
      feature.read(toCdr(image));
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "";
  };
  const auto says = [](const std::string& text, const char* part) {
    return text.find(part) != std::string::npos;
  };
  EXPECT_EQ(why([](Image& image) { image.data.resize(11 + 9); }), "") << "the last row's gap";
  EXPECT_TRUE(says(why([](Image& image) { image.data.resize(11 + 8); }), "all of its rows"));
  EXPECT_TRUE(says(why([](Image& image) { image.data.clear(); }), "all of its rows"));
  EXPECT_TRUE(says(why([](Image& image) { image.step = 8; }), "rows of 8 bytes"));
  EXPECT_TRUE(says(why([](Image& image) { image.step = 0xFFFFFFFF; }), "all of its rows"));
  EXPECT_TRUE(says(why([](Image& image) { image.encoding = "yuv422"; }), "'yuv422'"));
  EXPECT_TRUE(says(why([](Image& image) { image.width = 4097; }), "4097 x 2"));
  EXPECT_TRUE(says(why([](Image& image) { image.height = 0; }), "3 x 0"));
  EXPECT_TRUE(says(why([](Image& image) { image.height = 0xFFFFFFFF; }), "sides of 1 to 4096"));
  // A calibrated camera's pictures have its size.
  EXPECT_THROW(wordsOf(picture("rgb8", 3), {3, 3}), std::invalid_argument);
  EXPECT_NO_THROW(wordsOf(picture("rgb8", 3), {3, 2}));
}

TEST_F(LiveFeaturesTest, ComeWithOdometryOfTheirTime) {
  LiveReadings::Options options;
  options.features = {sonar()};
  options.odometry = {"odometry", "odometry", "pose"};
  options.base = "base_link";
  options.patience = std::chrono::milliseconds(600'000);  // on a busy machine, too
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

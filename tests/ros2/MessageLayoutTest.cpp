/// The order and sizes of the fields of each message, laid out by hand as the packages of ROS 2
/// define them, and messages of any content, which come back as they went.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cstring>

#include "Seeded.hpp"
#include "ortung/ros2/Messages.hpp"

namespace ortung::ros2 {
namespace {

/// Bytes behind the head, with the gaps that CDR puts before numbers.
class Layout {
 public:
  template <class T>
  Layout& number(T value) {
    while (bytes_.size() % sizeof value != 0) bytes_ += '\0';
    bytes_.append(reinterpret_cast<const char*>(&value), sizeof value);
    return *this;
  }
  Layout& u8(std::uint8_t value) { return number(value); }
  Layout& u32(std::uint32_t value) { return number(value); }
  Layout& f32(float value) { return number(value); }
  Layout& f64(std::initializer_list<double> values) {
    for (const double value : values) number(value);
    return *this;
  }
  Layout& text(const std::string& value) {
    u32(static_cast<std::uint32_t>(value.size() + 1));
    bytes_ += value + '\0';
    return *this;
  }
  /// A stamp of 3.000000004 s and a frame.
  Layout& header(const std::string& frame) { return u32(3).u32(4).text(frame); }
  Layout& zeros(int count) {
    for (int i = 0; i < count; ++i) number(0.0);
    return *this;
  }
  std::string bytes() const { return std::string("\0\1\0\0", 4) + bytes_; }

 private:
  std::string bytes_;
};

constexpr std::int64_t kStamp = 3'000'000'004;

TEST(MessageLayout, OfLaserScan) {
  LaserScan scan;
  scan.header = {kStamp, "laser"};
  scan.angleMin = -1.5F;
  scan.angleMax = 1.5F;
  scan.angleIncrement = 0.25F;
  scan.timeIncrement = 0.125F;
  scan.scanTime = 0.5F;
  scan.rangeMin = 0.1F;
  scan.rangeMax = 8.0F;
  scan.ranges = {1.0F, 2.0F};
  scan.intensities = {7.0F};
  Layout layout;
  layout.header("laser").f32(-1.5F).f32(1.5F).f32(0.25F).f32(0.125F).f32(0.5F).f32(0.1F).f32(8.0F);
  layout.u32(2).f32(1.0F).f32(2.0F).u32(1).f32(7.0F);
  EXPECT_EQ(toCdr(scan), layout.bytes());
}

TEST(MessageLayout, OfOdometry) {
  Odometry odometry;
  odometry.header = {kStamp, "odom"};
  odometry.childFrame = "base";
  odometry.pose = {{1, 2, 3}, {4, 5, 6, 7}};
  odometry.poseCovariance[35] = 0.5;
  odometry.linear = {8, 9, 10};
  odometry.angular = {11, 12, 13};
  odometry.twistCovariance[0] = 0.25;
  Layout layout;
  layout.header("odom").text("base").f64({1, 2, 3, 4, 5, 6, 7}).zeros(35).f64({0.5});
  layout.f64({8, 9, 10, 11, 12, 13, 0.25}).zeros(35);
  EXPECT_EQ(toCdr(odometry), layout.bytes());
}

TEST(MessageLayout, OfCommandsAndTheClock) {
  Layout twist;
  twist.f64({1, 2, 3, 4, 5, 6});
  EXPECT_EQ(toCdr(Twist{{1, 2, 3}, {4, 5, 6}}), twist.bytes());
  Layout stamped;
  stamped.header("base").f64({1, 2, 3, 4, 5, 6});
  EXPECT_EQ(toCdr(TwistStamped{{kStamp, "base"}, {{1, 2, 3}, {4, 5, 6}}}), stamped.bytes());
  EXPECT_EQ(toCdr(RosClock{kStamp}), Layout().u32(3).u32(4).bytes());
}

TEST(MessageLayout, OfTransforms) {
  TfMessage tf;
  tf.transforms.push_back({{kStamp, "map"}, "odom", {{1, 2, 3}, {4, 5, 6, 7}}});
  tf.transforms.push_back({{kStamp, "odom"}, "b", {{0, 0, 0}, {0, 0, 0, 1}}});
  Layout layout;
  layout.u32(2).header("map").text("odom").f64({1, 2, 3, 4, 5, 6, 7});
  layout.header("odom").text("b").f64({0, 0, 0, 0, 0, 0, 1});
  EXPECT_EQ(toCdr(tf), layout.bytes());
}

TEST(MessageLayout, OfPosesWithCovarianceAndOfArraysOfPoses) {
  PoseWithCovarianceStamped pose;
  pose.header = {kStamp, "map"};
  pose.pose = {{1, 2, 3}, {4, 5, 6, 7}};
  pose.covariance[1] = 0.5;
  Layout one;
  one.header("map").f64({1, 2, 3, 4, 5, 6, 7, 0, 0.5}).zeros(34);
  EXPECT_EQ(toCdr(pose), one.bytes());
  PoseArray poses;
  poses.header = {kStamp, "m"};
  poses.poses = {{{1, 2, 3}, {4, 5, 6, 7}}, {{8, 9, 10}, {0, 0, 0, 1}}};
  Layout two;
  two.header("m").u32(2).f64({1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 0, 0, 0, 1});
  EXPECT_EQ(toCdr(poses), two.bytes());
}

TEST(MessageLayout, OfDiagnostics) {
  DiagnosticArray array;
  array.header = {kStamp, ""};
  array.status = {{DiagnosticArray::Status::kWarn, "n", "m", "", {{"k", "v"}, {"key", "10"}}}};
  Layout layout;
  layout.header("").u32(1).u8(1).text("n").text("m").text("").u32(2);
  layout.text("k").text("v").text("key").text("10");
  EXPECT_EQ(toCdr(array), layout.bytes());
}

TEST(MessageLayout, OfOccupancyGrid) {
  OccupancyGrid map;
  map.header = {kStamp, "map"};
  map.mapLoadTime = 1'000'000'002;
  map.resolution = 0.05F;
  map.width = 2;
  map.height = 1;
  map.origin.position = {-1, -2, 0};
  map.data = {-1, 100};
  Layout layout;
  layout.header("map").u32(1).u32(2).f32(0.05F).u32(2).u32(1).f64({-1, -2, 0, 0, 0, 0, 1});
  layout.u32(2).u8(255).u8(100);
  EXPECT_EQ(toCdr(map), layout.bytes());
}

TEST(MessageLayout, OfRangeAndImage) {
  Range range;
  range.header = {kStamp, "sonar"};
  range.radiationType = 1;
  range.fieldOfView = 0.5F;
  range.minRange = 0.25F;
  range.maxRange = 4.0F;
  range.range = 2.0F;
  Layout cone;
  cone.header("sonar").u8(1).f32(0.5F).f32(0.25F).f32(4.0F).f32(2.0F);
  EXPECT_EQ(toCdr(range), cone.bytes());
  Image image;
  image.header = {kStamp, "camera"};
  image.height = 1;
  image.width = 2;
  image.encoding = "mono8";
  image.isBigEndian = 1;
  image.step = 3;
  image.data = {9, 8, 7};
  Layout picture;
  picture.header("camera").u32(1).u32(2).text("mono8").u8(1).u32(3).u32(3).u8(9).u8(8).u8(7);
  EXPECT_EQ(toCdr(image), picture.bytes());
}

TEST(MessageLayout, OfImu) {
  Imu imu;
  imu.header = {kStamp, "imu"};
  imu.orientation = {1, 2, 3, 4};
  imu.orientationCovariance[8] = 0.5;
  imu.angular = {5, 6, 7};
  imu.angularCovariance[0] = -1;
  imu.acceleration = {8, 9, 10};
  imu.accelerationCovariance[1] = 0.25;
  Layout layout;
  layout.header("imu").f64({1, 2, 3, 4}).zeros(8).f64({0.5, 5, 6, 7, -1}).zeros(8);
  layout.f64({8, 9, 10, 0, 0.25}).zeros(7);
  EXPECT_EQ(toCdr(imu), layout.bytes());
}

// The second message has the memory of the first one, and nothing else of it.
TEST(MessageLayout, AMessageMayBeReadIntoOneThatIsThere) {
  PointCloud cloud;
  cloud.header = {kStamp, "a frame that is long enough to need memory"};
  cloud.fields = {{"x", 0, PointCloud::Field::kFloat, 1}, {"n", 4, PointCloud::Field::kWord, 1}};
  cloud.data.resize(1000, 7);
  PointCloud read;
  std::string why;
  ASSERT_TRUE(fromCdr(toCdr(cloud), read, why)) << why;
  const std::uint8_t* memory = read.data.data();
  EXPECT_EQ(read.data, cloud.data);
  EXPECT_EQ(read.header.frame, cloud.header.frame);
  cloud.data.assign(999, 8);
  cloud.fields.pop_back();
  ASSERT_TRUE(fromCdr(toCdr(cloud), read, why)) << why;
  EXPECT_EQ(read.data, cloud.data);
  EXPECT_EQ(read.data.data(), memory);
  EXPECT_EQ(read.fields.size(), 1u);
  EXPECT_FALSE(fromCdr(toCdr(cloud).substr(0, 50), read, why));
  EXPECT_NE(why, "");
}

TEST(MessageLayout, OfPointCloudAndWords) {
  PointCloud cloud;
  cloud.header = {kStamp, "radar"};
  cloud.width = 1;
  cloud.fields = {{"x", 0, PointCloud::Field::kFloat, 1}, {"n", 4, PointCloud::Field::kWord, 1}};
  cloud.pointStep = 8;
  cloud.rowStep = 8;
  cloud.data = {1, 2};
  cloud.isDense = false;
  Layout points;
  points.header("radar").u32(1).u32(1).u32(2).text("x").u32(0).u8(7).u32(1);
  points.text("n").u32(4).u8(6).u32(1).u8(0).u32(8).u32(8).u32(2).u8(1).u8(2).u8(0);
  EXPECT_EQ(toCdr(cloud), points.bytes());
  Words words;
  words.dimensions = {{"row", 2, 4}};
  words.offset = 5;
  words.data = {7, 4294967295U};
  Layout array;
  array.u32(1).text("row").u32(2).u32(4).u32(5).u32(2).u32(7).u32(4294967295U);
  EXPECT_EQ(toCdr(words), array.bytes());
}

/// The same message, written and read.
template <class M>
M again(const M& message) {
  std::string why;
  const auto back = fromCdr<M>(toCdr(message), why);
  RC_ASSERT(why.empty());
  RC_ASSERT(back.has_value());
  return *back;
}

/// A stamp within 2^31 s of 1970 [ns].
std::int64_t anyStamp() {
  return *rc::gen::inRange<std::int64_t>(-2'147'483'648LL, 2'147'483'648LL) * 1'000'000'000 +
         *rc::gen::inRange<std::int64_t>(0, 1'000'000'000);
}

// Texts and lists of any length put what follows them anywhere between two gaps.
RC_GTEST_PROP(MessageProperty, ScansComeBack, ()) {
  LaserScan scan;
  scan.header = {anyStamp(), *rc::gen::string<std::string>()};
  scan.angleMin = *rc::gen::arbitrary<float>();
  scan.rangeMax = *rc::gen::arbitrary<float>();
  scan.ranges = *rc::gen::arbitrary<std::vector<float>>();
  scan.intensities = *rc::gen::arbitrary<std::vector<float>>();
  const LaserScan back = again(scan);
  RC_ASSERT(back.header.stamp == scan.header.stamp);
  RC_ASSERT(back.header.frame == scan.header.frame);
  RC_ASSERT(back.angleMin == scan.angleMin);
  RC_ASSERT(back.rangeMax == scan.rangeMax);
  RC_ASSERT(back.ranges == scan.ranges);
  RC_ASSERT(back.intensities == scan.intensities);
}

RC_GTEST_PROP(MessageProperty, TransformsComeBack, ()) {
  TfMessage tf;
  const auto names = *rc::gen::arbitrary<std::vector<std::string>>();
  for (const std::string& name : names)
    tf.transforms.push_back({{anyStamp(), name}, name + "'", {{1, 2, 3}, {4, 5, 6, 7}}});
  const TfMessage back = again(tf);
  RC_ASSERT(back.transforms.size() == names.size());
  for (std::size_t i = 0; i < names.size(); ++i) {
    RC_ASSERT(back.transforms[i].header.stamp == tf.transforms[i].header.stamp);
    RC_ASSERT(back.transforms[i].header.frame == names[i]);
    RC_ASSERT(back.transforms[i].childFrame == names[i] + "'");
    RC_ASSERT(back.transforms[i].transform.orientation.w == 7.0);
  }
}

RC_GTEST_PROP(MessageProperty, WordsAndPicturesComeBack, ()) {
  Words words;
  words.data = *rc::gen::arbitrary<std::vector<std::uint32_t>>();
  RC_ASSERT(again(words).data == words.data);
  Image image;
  image.encoding = *rc::gen::string<std::string>();
  image.step = *rc::gen::arbitrary<std::uint32_t>();
  image.data = *rc::gen::arbitrary<std::vector<std::uint8_t>>();
  const Image back = again(image);
  RC_ASSERT(back.encoding == image.encoding);
  RC_ASSERT(back.step == image.step);
  RC_ASSERT(back.data == image.data);
}

/// Whatever bytes come: a message or a reason, never both.
template <class M>
void expectMessageOrReason(const std::string& bytes) {
  std::string why;
  const auto message = fromCdr<M>(bytes, why);
  RC_ASSERT(message.has_value() == why.empty());
  RC_ASSERT(why.empty() || why.starts_with("found "));
}

RC_GTEST_PROP(MessageProperty, AnyBytesAreAMessageOrRefused, ()) {
  const auto rest = *rc::gen::container<std::string>(rc::gen::weightedOneOf<char>(
      {{3, rc::gen::elementOf(std::string("\0\1\2\3", 4))}, {1, rc::gen::arbitrary<char>()}}));
  for (const char order : {'\0', '\1'}) {
    const std::string bytes = std::string{'\0', order, '\0', '\0'} + rest;
    expectMessageOrReason<LaserScan>(bytes);
    expectMessageOrReason<TfMessage>(bytes);
    expectMessageOrReason<PointCloud>(bytes);
    expectMessageOrReason<Words>(bytes);
  }
}

/// Why these bytes are no message of texts or times.
template <class M>
std::string whyNot(const std::string& bytes) {
  std::string why;
  EXPECT_FALSE(fromCdr<M>(bytes, why));
  return why;
}

TEST(Cdr, SaysWhatIsWrongWithAMessage) {
  EXPECT_EQ(whyNot<Words>(std::string("\0\1\0", 3)),
            "found a message shorter than the head of CDR");
  for (const std::string& head : {std::string("\1\1\0\0", 4), std::string("\0\2\0\0", 4)})
    EXPECT_EQ(whyNot<Words>(head),
              "found a message whose head is not that of CDR of plain types (0 0 or 0 1)");
  EXPECT_EQ(whyNot<PoseStamped>(Layout().u32(1).u32(1'000'000'000).text("").bytes()),
            "found a time of more than 999999999 ns beside its seconds");
  EXPECT_EQ(whyNot<PoseStamped>(Layout().u32(1).u32(0).u32(2).u8('m').u8('a').bytes()),
            "found a text that does not end with a zero");
  EXPECT_EQ(whyNot<PoseStamped>(Layout().header("m").f64({1, 2}).bytes()),
            "found the end of a message within a field");
  EXPECT_EQ(whyNot<Words>(Layout().u32(0).u32(0).u32(2).u32(7).bytes()),
            "found a list of 2 elements in the last 4 bytes of a message");
}

// Some writers leave the zero of an empty text out.
TEST(Cdr, AnEmptyTextMayHaveNoZero) {
  Layout layout;
  layout.u32(3).u32(4).u32(0).f64({1, 2, 3, 4, 5, 6, 7});
  std::string why;
  const auto pose = fromCdr<PoseStamped>(layout.bytes(), why);
  ASSERT_TRUE(pose) << why;
  EXPECT_EQ(pose->header.frame, "");
  EXPECT_EQ(pose->pose.orientation.w, 7.0);
}

// Every number of a big-endian message is turned round, those of lists, too; bytes are not.
TEST(Cdr, ListsOfBigEndianMessagesAreTurnedRound) {
  using namespace std::string_literals;
  const std::string words =
      "\x00\x00\x00\x00"s +                                  // head: big-endian
      "\x00\x00\x00\x00\x00\x00\x00\x05\x00\x00\x00\x02"s +  // no dimension, offset, 2 words
      "\x00\x00\x00\x07\x01\x02\x03\x04"s;
  std::string why;
  const auto read = fromCdr<Words>(words, why);
  ASSERT_TRUE(read) << why;
  EXPECT_EQ(read->offset, 5u);
  EXPECT_EQ(read->data, (std::vector<std::uint32_t>{7, 0x01020304}));
}

}  // namespace
}  // namespace ortung::ros2

#include <gtest/gtest.h>

#include <cmath>

#include "ortung/ros2/Messages.hpp"

namespace ortung::ros2 {
namespace {

using namespace std::string_literals;

/// A PoseStamped at 1.000000002 s in the frame "ma" at x = 1 m, laid out by hand: numbers lie at
/// multiples of their size behind the head, so a byte is left out after the text's zero.
const std::string kPose =
    "\x00\x01\x00\x00"s                  // little endian
    "\x01\x00\x00\x00\x02\x00\x00\x00"   // sec, nanosec
    "\x03\x00\x00\x00ma\x00\x00"s        // a text with its zero, and a gap
    "\x00\x00\x00\x00\x00\x00\xF0\x3F"s  // x = 1
    "\x00\x00\x00\x00\x00\x00\x00\x00"s  // y
    "\x00\x00\x00\x00\x00\x00\x00\x00"s  // z
    "\x00\x00\x00\x00\x00\x00\x00\x00"s  // orientation: x, y, z, w = 1
    "\x00\x00\x00\x00\x00\x00\x00\x00"s
    "\x00\x00\x00\x00\x00\x00\x00\x00"s
    "\x00\x00\x00\x00\x00\x00\xF0\x3F"s;

TEST(Cdr, LaysFieldsOutAsTheSpecificationSays) {
  PoseStamped pose;
  pose.header = {1'000'000'002, "ma"};
  pose.pose.position.x = 1.0;
  EXPECT_EQ(toCdr(pose), kPose);
}

TEST(Cdr, AFlagIsSetByAnyByteButZero) {
  PointCloud cloud;
  std::string bytes = toCdr(cloud);
  std::string why;
  for (const auto& [byte, isSet] : {std::pair('\0', false), {'\1', true}, {'\x28', true}}) {
    bytes.back() = byte;  // isDense is the last field
    const auto read = fromCdr<PointCloud>(bytes, why);
    ASSERT_TRUE(read) << why;
    EXPECT_EQ(read->isDense, isSet);
    EXPECT_EQ(toCdr(*read).back(), isSet ? '\1' : '\0');
  }
}

TEST(Cdr, ReadsEitherOrderOfBytes) {
  std::string big = "\x00\x00\x00\x00\x00\x00\x00\x01\x00\x00\x00\x02\x00\x00\x00\x03ma\x00\x00"s;
  big += "\x3F\xF0\x00\x00\x00\x00\x00\x00"s + std::string(40, '\0') +
         "\x3F\xF0\x00\x00\x00\x00\x00\x00"s;
  for (const std::string& bytes : {kPose, big}) {
    std::string why;
    const auto pose = fromCdr<PoseStamped>(bytes, why);
    ASSERT_TRUE(pose) << why;
    EXPECT_EQ(pose->header.stamp, 1'000'000'002);
    EXPECT_EQ(pose->header.frame, "ma");
    EXPECT_EQ(pose->pose.position.x, 1.0);
    EXPECT_EQ(pose->pose.orientation.w, 1.0);
  }
}

TEST(Cdr, TimesBefore1970HaveNegativeSecondsAndPositiveNanoseconds) {
  PoseStamped pose;
  pose.header.stamp = -1;
  const std::string bytes = toCdr(pose);
  EXPECT_EQ(bytes.substr(4, 8), "\xFF\xFF\xFF\xFF\xFF\xC9\x9A\x3B"s);  // -1 s + 999999999 ns
  std::string why;
  EXPECT_EQ(fromCdr<PoseStamped>(bytes, why)->header.stamp, -1);
}

TEST(Cdr, RefusesEveryMessageThatIsCutOff) {
  LaserScan scan;
  scan.header.frame = "laser";
  scan.ranges = {1.0F, std::nanf(""), 3.0F};
  scan.intensities = {7.0F};
  const std::string whole = toCdr(scan);
  std::string why;
  const auto back = fromCdr<LaserScan>(whole + "more", why);  // later versions of a type
  ASSERT_TRUE(back) << why;
  EXPECT_TRUE(std::isnan(back->ranges[1]));
  EXPECT_EQ(back->ranges[2], 3.0F);
  EXPECT_EQ(back->intensities, scan.intensities);
  for (std::size_t size = 0; size < whole.size(); ++size) {
    EXPECT_FALSE(fromCdr<LaserScan>(whole.substr(0, size), why)) << size;
    EXPECT_NE(why, "");
  }
}

TEST(Cdr, BelievesNoLengthThatIsNotThere) {
  PoseArray poses;
  poses.poses.resize(2);
  std::string bytes = toCdr(poses);
  std::string why;
  bytes[4 + 16] = '\xFF';  // behind the stamp and an empty text with its gap: the length
  bytes[4 + 19] = '\x7F';
  EXPECT_FALSE(fromCdr<PoseArray>(bytes, why));
  EXPECT_NE(why.find("a list of 2130706687 elements"), why.npos) << why;
  EXPECT_FALSE(fromCdr<PoseArray>("\x00\x07\x00\x00rest"s, why));
  EXPECT_NE(why.find("head"), why.npos) << why;
}

TEST(Schemas, NameAllThatATypeIsMadeOf) {
  const std::string text = schemaText("sensor_msgs/msg/LaserScan");
  EXPECT_TRUE(text.starts_with("std_msgs/Header header\nfloat32 angle_min\n")) << text;
  const std::size_t header = text.find("MSG: std_msgs/Header\n");
  EXPECT_NE(header, text.npos);
  EXPECT_NE(text.find("MSG: builtin_interfaces/Time\nint32 sec\nuint32 nanosec\n", header),
            text.npos);
  EXPECT_EQ(schemaText("sensor_msgs/msg/JointState"), "");
}

}  // namespace
}  // namespace ortung::ros2

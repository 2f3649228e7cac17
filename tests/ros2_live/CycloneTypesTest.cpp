/// Every message both ways, beside the serializers that Cyclone DDS makes of the types: what a
/// program on Cyclone writes are the bytes that we make of the same values, and what it reads of
/// ours, and writes anew, are these bytes again. So it has read each field as we have meant it.
#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <condition_variable>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <map>
#include <mutex>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "NodeMessages.hpp"
#include "Participant.hpp"
#include "Paths.hpp"
#include "ortung/ros2/Messages.hpp"

namespace ortung::ros2 {
namespace {

constexpr std::int64_t kStamp = 1'700'000'000'123'456'789;

Pose poseFrom(double first) {
  return {{first, first + 1, first + 2}, {first + 3, first + 4, first + 5, first + 6}};
}
Twist twistFrom(double first) {
  return {{first, first + 1, first + 2}, {first + 3, first + 4, first + 5}};
}
Covariance covarianceFrom(double first) {
  Covariance all{};
  all[0] = first;
  all[7] = first + 1;
  all[34] = first + 2;
  all[35] = first + 3;
  return all;
}

std::string odometry() {
  Odometry out;
  out.header = {kStamp, "odom"};
  out.childFrame = "base_link";
  out.pose = poseFrom(10.0);
  out.poseCovariance = covarianceFrom(20.0);
  out.linear = twistFrom(30.0).linear;
  out.angular = twistFrom(30.0).angular;
  out.twistCovariance = covarianceFrom(40.0);
  return toCdr(out);
}
OccupancyGrid grid() {
  OccupancyGrid out;
  out.header = {kStamp, "map"};
  out.mapLoadTime = 7'000'000'008;
  out.resolution = 0.05F;
  out.width = 3;
  out.height = 1;
  out.origin = poseFrom(-1.0);
  out.data = {-1, 0, 100};
  return out;
}
std::string laserScan() {
  LaserScan out;
  out.header = {kStamp, "laser"};
  out.angleMin = -1.5F;
  out.angleMax = 1.5F;
  out.angleIncrement = 0.25F;
  out.timeIncrement = 0.125F;
  out.scanTime = 0.0625F;
  out.rangeMin = 0.1F;
  out.rangeMax = 8.0F;
  out.ranges = {1.0F, 2.5F, 3.0F};
  out.intensities = {7.0F};
  return toCdr(out);
}
/// As Iron and later have it: its variance is not known.
std::string range() {
  Range out;
  out.header = {kStamp, "sonar"};
  out.radiationType = 1;
  out.fieldOfView = 0.5F;
  out.minRange = 0.25F;
  out.maxRange = 4.0F;
  out.range = 2.0F;
  return toCdr(out) + std::string(sizeof(float), '\0');
}
std::string image() {
  Image out;
  out.header = {kStamp, "camera"};
  out.height = 2;
  out.width = 3;
  out.encoding = "mono8";
  out.isBigEndian = 1;
  out.step = 4;
  out.data = {9, 8, 7, 255, 1};
  return toCdr(out);
}
std::string imu() {
  Imu out;
  out.header = {kStamp, "imu"};
  out.orientation = {1, 2, 3, 4};
  out.orientationCovariance = {5, 0, 0, 0, 0, 0, 0, 0, 6};
  out.angular = {7, 8, 9};
  out.angularCovariance = {10, 0, 0, 0, 0, 0, 0, 0, 11};
  out.acceleration = {12, 13, 14};
  out.accelerationCovariance = {15, 0, 0, 0, 0, 0, 0, 0, 16};
  return toCdr(out);
}
std::string pointCloud() {
  PointCloud out;
  out.header = {kStamp, "radar"};
  out.height = 1;
  out.width = 2;
  out.fields = {{"x", 0, 7, 1}, {"number", 4, 6, 2}};
  out.isBigEndian = true;
  out.pointStep = 8;
  out.rowStep = 16;
  out.data = {1, 2, 3};
  out.isDense = false;
  return toCdr(out);
}
std::string transforms() {
  TfMessage out;
  out.transforms = {{{kStamp, "odom"}, "base_link", {{1, 2, 3}, {4, 5, 6, 7}}},
                    {{kStamp, "map"}, "odom", {{8, 9, 10}, {11, 12, 13, 14}}}};
  return toCdr(out);
}

struct Known {
  std::string_view type;
  std::string cdr;
};

/// The messages that cyclone_types fills, by the names of their types.
std::map<std::string, Known> messages() {
  const auto all = std::vector<Known>{
      {Twist::kType, toCdr(twistFrom(0.5))},
      {TwistStamped::kType, toCdr(TwistStamped{{kStamp, "base"}, twistFrom(-2.5)})},
      {RosClock::kType, toCdr(RosClock{12'345'678'901})},
      {PoseStamped::kType, toCdr(PoseStamped{{kStamp, "map"}, poseFrom(1.25)})},
      {PoseWithCovarianceStamped::kType,
       toCdr(PoseWithCovarianceStamped{{kStamp, "mapp"}, poseFrom(-3.5), covarianceFrom(0.125)})},
      {Odometry::kType, odometry()},
      {PoseArray::kType, toCdr(PoseArray{{kStamp, "map"}, {poseFrom(1.0), poseFrom(2.0)}})},
      {ParticleCloud::kType,
       toCdr(ParticleCloud{{kStamp, "map"}, {{poseFrom(1.0), 0.75}, {poseFrom(2.0), 0.25}}})},
      {TfMessage::kType, transforms()},
      {OccupancyGrid::kType, toCdr(grid())},
      {Text::kType, cdrOf(Text{"ground"})},
      {"nav2_msgs/srv/LoadMap_Request", cdrOf(std::string("/maps/first.yaml"))},
      {"nav2_msgs/srv/LoadMap_Response", cdrOf(LoadedMap{grid(), LoadedMap::kInvalidMetadata})},
      {LaserScan::kType, laserScan()},
      {Range::kType, range()},
      {Image::kType, image()},
      {Imu::kType, imu()},
      {PointCloud::kType, pointCloud()},
      {DiagnosticArray::kType,
       toCdr(DiagnosticArray{
           {kStamp, ""},
           {{1, "localization", "uncertain", "none", {{"quality", "0.5"}, {"k", "v"}}}}})},
      {Words::kType, toCdr(Words{{{"row", 2, 4}}, 5, {7, 4294967295U}})}};
  std::map<std::string, Known> named;
  for (const Known& one : all) named[std::string(one.type.substr(one.type.rfind('/') + 1))] = one;
  return named;
}

/// Bytes without those at the end that only make their number a multiple of four; DDS says in the
/// head how many these are.
std::string trimmed(std::string_view cdr) {
  constexpr std::size_t kOptions = 3;
  std::string bytes(cdr);
  const std::size_t pad = bytes.size() > kOptions ? bytes[kOptions] & 3 : 0;
  bytes.resize(bytes.size() - pad);
  bytes[kOptions] = static_cast<char>(bytes[kOptions] & ~3);
  return bytes;
}

/// What has come, by topic.
class Arrivals {
 public:
  void take(const std::string& topic, std::string_view cdr) {
    const std::lock_guard lock(mutex_);
    newest_[topic] = trimmed(cdr);
    arrived_.notify_all();
  }
  /// Whether so many topics have a message within a time that nobody needs.
  bool waitFor(std::size_t count) {
    std::unique_lock lock(mutex_);
    return arrived_.wait_for(lock, std::chrono::seconds(60),
                             [&] { return newest_.size() >= count; });
  }
  std::string at(const std::string& topic) {
    const std::lock_guard lock(mutex_);
    return newest_[topic];
  }

 private:
  std::mutex mutex_;
  std::condition_variable arrived_;
  std::map<std::string, std::string> newest_;
};

std::string hex(const std::string& bytes) {
  std::string text;
  char digits[4];
  for (const char c : bytes) {
    std::snprintf(digits, sizeof digits, "%02x ", static_cast<unsigned char>(c));
    text += digits;
  }
  return text;
}

TEST(CycloneTypes, AreAllThatThereAre) {
  std::ifstream in(ORTUNG_SOURCE_DIR "/realsensors/ros2/include/ortung/ros2/Messages.hpp");
  const std::string header{std::istreambuf_iterator<char>(in), {}};
  const std::regex type("kType = \"([a-z0-9_]+/msg/\\w+)\"");
  // Beside those that everybody knows, those of a node that has maps.
  std::set<std::string> wanted = {"std_msgs/msg/String", "nav2_msgs/srv/LoadMap_Request",
                                  "nav2_msgs/srv/LoadMap_Response"};
  for (std::sregex_iterator one(header.begin(), header.end(), type), end; one != end; ++one)
    wanted.insert((*one)[1]);
  std::set<std::string> known;
  for (const auto& [name, message] : messages()) known.insert(std::string(message.type));
  EXPECT_EQ(known, wanted);
}

TEST(CycloneTypes, HaveTheBytesThatWeMakeAndReadThem) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "Fast DDS 2.9 frees memory as another type than it was, and knows no sanitizer";
#endif
  const std::map<std::string, Known> known = messages();
  Participant::Options options;
  options.isLocal = true;
  options.domain = 1 + static_cast<std::uint32_t>(getpid()) % 40;  // one of the test's own
  options.names.node = "types";
  Arrivals arrivals;
  Participant node(options);
  for (const auto& [name, message] : known) {
    for (const std::string& topic : {"/from_cyclone/" + name, "/echo/" + name})
      node.subscribe(topic, message.type, Qos::kLatched,
                     [&arrivals, topic](std::string_view cdr) { arrivals.take(topic, cdr); });
    node.publish("/to_cyclone/" + name, message.type, Qos::kLatched)(message.cdr);
  }
  setenv("CYCLONEDDS_URI",
         "<General><Interfaces><NetworkInterface name=\"lo\" multicast=\"true\"/></Interfaces>"
         "<AllowMulticast>true</AllowMulticast></General>",
         1);
  const std::string program =
      std::string(ORTUNG_CYCLONE_TYPES) + " " + std::to_string(options.domain);
  std::FILE* const peer = popen(program.c_str(), "w");
  ASSERT_NE(peer, nullptr);
  EXPECT_TRUE(arrivals.waitFor(2 * known.size()));
  EXPECT_EQ(pclose(peer), 0);
  for (const auto& [name, message] : known) {
    EXPECT_EQ(hex(arrivals.at("/from_cyclone/" + name)), hex(message.cdr)) << name;
    EXPECT_EQ(hex(arrivals.at("/echo/" + name)), hex(message.cdr)) << name;
  }
}

}  // namespace
}  // namespace ortung::ros2

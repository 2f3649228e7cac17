/// What options choose of a bag, and what messages of a bag are refused.
#include <cmath>
#include <limits>

#include "BagMaker.hpp"
#include "LogTesting.hpp"
#include "ortung/camera/ImageData.hpp"

namespace ortung {
namespace {

using namespace ortung::testing;
using namespace ros2;
using Texts = std::vector<std::string>;

const std::string kWheels = "odometry/odometry/pose";
const std::string kTruth = "reference/groundTruth/pose";

class BagOptions : public ::testing::Test {
 protected:
  std::string write(BagMaker& maker) const {
    return "mcap:" + folder_.write("run.mcap", maker.bytes()).string();
  }
  std::string path() const { return (folder_.path() / "run.mcap").string(); }
  /// The error of a bag of one message, behind the file's name.
  template <class M>
  std::string complaint(const std::string& topic, const M& message,
                        const std::string& options = "") const {
    BagMaker maker;
    maker.add(topic, message);
    const std::string error = errorOf(write(maker) + options);
    const std::string start = path() + ": ";
    EXPECT_TRUE(error.empty() || error.starts_with(start)) << error;
    return error.substr(std::min(error.size(), start.size()));
  }
  TemporaryFolder folder_;
};

ros2::Range rangeOf(std::int64_t stamp, float range, float maxRange = 4.0F, float cone = 0.5F) {
  ros2::Range message;
  message.header = {stamp, "sonar"};
  message.fieldOfView = cone;
  message.maxRange = maxRange;
  message.range = range;
  return message;
}

Image imageOf(const std::string& encoding, std::uint32_t width, std::uint32_t height,
              std::uint32_t step, std::vector<std::uint8_t> data) {
  Image image;
  image.header = {kSecond, "camera"};
  image.encoding = encoding;
  image.width = width;
  image.height = height;
  image.step = step;
  image.data = std::move(data);
  return image;
}

TEST_F(BagOptions, TopicsAreChosenByTheirNames) {
  BagMaker maker;
  maker.add("/a", odometryAt(kSecond, 1, 0)).add("/b", odometryAt(kSecond, 2, 0));
  maker.add("/scan", scanOf(kSecond, "base_footprint", {1.0F}))
      .add("/top", scanOf(kSecond, "base_footprint", {2.0F}));
  const std::string bag = write(maker);
  const auto xOf = [&](const std::string& options) {
    return only(readAll(bag + options), kWheels).at(0).words[0] - (1U << 31);
  };
  EXPECT_EQ(xOf(""), 1000u) << "the first one";
  EXPECT_EQ(xOf("?odometry=/b"), 2000u);
  EXPECT_EQ(errorOf(bag + "?odometry=/c"),
            path() +
                ": found no message at the topic '/c' that the option odometry names, "
                "expected one with nav_msgs/msg/Odometry: '/a', '/b'");
  EXPECT_EQ(asText(only(readAll(bag + "?scans=/top"), "laser/LRF/scan")),
            (Texts{"1000000 laser/LRF/scan 2000"}));
  EXPECT_EQ(only(readAll(bag + "?scans=/scan,/top"), "top/LRF/scan").size(), 1u);
  EXPECT_EQ(readAll(bag + "?scans=none").size(), 1u);
  EXPECT_EQ(errorOf(bag + "?truth=/c"),
            path() +
                ": found no message at the topic '/c' that the option truth names, expected "
                "one with geometry_msgs/msg/PoseStamped: '/a', '/b'");
  EXPECT_EQ(errorOf(bag + "?scans=/scan,/nope"),
            path() +
                ": found no message at the topic '/nope' that the option scans names, "
                "expected one with sensor_msgs/msg/LaserScan: '/scan', '/top'");
  EXPECT_EQ(errorOf(bag + "?ranges=/scan"),
            path() +
                ": found no message at the topic '/scan' that the option ranges names, "
                "expected one with sensor_msgs/msg/Range: there is none");
  EXPECT_NE(errorOf(bag + "?images=/i").find("sensor_msgs/msg/Image: there is none"), bag.npos);
  EXPECT_NE(errorOf(bag + "?map=/m").find("nav_msgs/msg/OccupancyGrid: there is none"), bag.npos);
  EXPECT_EQ(errorOf(bag + "?odometry=tf"),
            path() +
                ": found no transform to the frame 'base_link' at /tf, expected the robot's "
                "odometry there; frames are 'base_footprint', and the option base names the "
                "robot's");
  EXPECT_EQ(asText(only(readAll(bag + "?truth=/b"), kTruth)),
            (Texts{"1000000 reference/groundTruth/pose 2147485648 2147483648 18000"}))
      << "odometry may be a reference, too";
}

TEST_F(BagOptions, TimesAreThoseOfHeadersOrOfRecording) {
  BagMaker maker;
  maker.add("/odom", odometryAt(-1, 1, 0)).add("/odom", odometryAt(2 * kSecond + 999, 1, 0));
  const std::string bag = write(maker);
  const auto stampsOf = [&](const std::string& options) {
    std::vector<Timestamp> stamps;
    for (const Message& message : readAll(bag + options)) stamps.push_back(message.stamp);
    return stamps;
  };
  EXPECT_EQ(stampsOf(""), (std::vector<Timestamp>{-1, 2'000'000})) << "cut towards the past";
  EXPECT_EQ(stampsOf("?stamps=log"), (std::vector<Timestamp>{0})) << "1 and 2 ns: the later one";
  EXPECT_NE(errorOf(bag + "?stamps=now").find("stamps is 'now'"), std::string::npos);
}

// Of the frame the option names: the robot is what is told of it, not of the odometry's frame.
TEST_F(BagOptions, TheRobotsFrameMayBeNamed) {
  BagMaker maker;
  maker.add("/odom", odometryAt(kSecond, 1, 0))
      .add("/tf_static", frameAt("chassis", "base_footprint", {{0.5, 0, 0}, {}}))
      .add("/tf_static", frameAt("chassis", "laser", {{1, 0.25, 0}, {}}))
      .add("/scan", scanOf(kSecond, "laser", {1.0F}));
  const std::string bag = write(maker);
  EXPECT_NE(makeSource(bag)->robotToml().find("x_m = 0.5, y_m = 0.25"), std::string::npos);
  EXPECT_NE(makeSource(bag + "?base=chassis")->robotToml().find("x_m = 1.0, y_m = 0.25"),
            std::string::npos);
  EXPECT_EQ(errorOf(bag + "?base=base_lnk"),
            path() +
                ": found no frame 'base_lnk' that the option base names, expected one of "
                "'base_footprint', 'chassis', 'laser'");
}

TEST_F(BagOptions, MountsAreTakenAsTheyAreTold) {
  BagMaker maker;
  maker.add("/odom", odometryAt(0, 0, 0))
      .add("/left", scanOf(0, "l", {1.0F}))
      .add("/right", scanOf(0, "r:2", {1.0F}));
  const std::string bag = write(maker);
  const std::string toml = makeSource(bag + "?mounts=l:0.5,0.25,-90;r:2:0,-1,30")->robotToml();
  EXPECT_NE(toml.find("x_m = 0.5, y_m = 0.25, theta_deg = -90.0"), toml.npos) << toml;
  EXPECT_NE(toml.find("x_m = 0.0, y_m = -1.0, theta_deg = 30.0"), toml.npos) << toml;
  for (const char* mounts : {"l", "l:1,2", "l:1,2,3,4,5", "l:1,2,x", "l:0,0,0;;r:0,0,0"})
    EXPECT_NE(errorOf(bag + "?mounts=" + mounts).find("must be FRAME:x,y,theta in m and degrees"),
              std::string::npos)
        << mounts;
}

TEST_F(BagOptions, MountsAreOfSensorsThatAreThereAndNear) {
  BagMaker maker;
  maker.add("/odom", odometryAt(0, 0, 0)).add("/scan", scanOf(0, "laser", {1.0F}));
  const std::string bag = write(maker);
  EXPECT_EQ(errorOf(bag + "?mounts=lazer:0,0,0"),
            path() +
                ": found no sensor in the frame 'lazer' that the option mounts names, "
                "expected one of 'laser'");
  for (const char* mount : {"laser:10.1,0,0", "laser:0,-1e300,0"})
    EXPECT_NE(errorOf(bag + "?mounts=" + mount).find("must be within 10 m"), bag.npos) << mount;
  BagMaker far;
  far.add("/odom", odometryAt(0, 0, 0))
      .add("/tf_static", frameAt("base_footprint", "laser", {{500, 0, 0}, {}}))
      .add("/scan", scanOf(0, "laser", {1.0F}));
  EXPECT_EQ(makeSource(write(far))->remark(),
            "the frame 'laser' of /scan is 500.0 m from 'base_footprint'; the option mounts sets "
            "where it is");
}

TEST_F(BagOptions, WhatCanNotBeIsLeftOutAndCounted) {
  BagMaker maker;
  Odometry far = odometryAt(2 * kSecond, 1e300, 0);
  Odometry fast = odometryAt(3 * kSecond, 1, 1e300);
  Odometry nothing = odometryAt(4 * kSecond, 1, 0);
  nothing.pose.orientation = {0, 0, 0, 0};
  maker.add("/odom", odometryAt(kSecond, 1, 0)).add("/odom", far).add("/odom", fast);
  maker.add("/odom", nothing).add("/odom", odometryAt(5 * kSecond, 2, 0));
  maker.add("/ground_truth", odometryAt(kSecond, 1, 0)).add("/ground_truth", far);
  maker.add("/tf_static", frameAt("base_footprint", "laser", {{1e300, 0, 0}, {}}));
  maker.add("/tf", frameAt("odom", "base_footprint", {{std::nan(""), 0, 0}, {}}));
  const auto source = makeSource(write(maker));
  const auto messages = readAll(*source);
  EXPECT_EQ(only(messages, kWheels).size(), 2u);
  EXPECT_EQ(only(messages, kTruth).size(), 1u);
  const std::string remark = source->remark();
  for (const char* expected :
       {"2 messages of /odom have a place that is no number or beyond 1000 km, and were left out",
        "1 messages of /odom have a velocity that is no number or above 100 m/s or rad/s, and",
        "1 messages of /ground_truth have a place that", "1 messages of /tf_static have transforms",
        "1 messages of /tf have transforms that are no numbers or beyond 1000 km"})
    EXPECT_NE(remark.find(expected), remark.npos) << expected << "\n" << remark;
}

TEST_F(BagOptions, TimesThatDoNotRiseAreCounted) {
  BagMaker maker;
  for (const int second : {1, 5, 3, 5, 6}) maker.add("/odom", odometryAt(second * kSecond, 1, 0));
  maker.add("/scan", scanOf(kSecond, "base_footprint", {1.0F}))
      .add("/scan", scanOf(2 * kSecond, "base_footprint", {1.0F}));
  const auto source = makeSource(write(maker));
  EXPECT_EQ(only(readAll(*source), kWheels).size(), 4u);
  EXPECT_EQ(source->remark(),
            "1 messages of /odom have earlier times than those before them, by up to 2.0 s, and "
            "were put in the order of time; 1 messages of /odom have the time of the one before "
            "them, and take its place");
}

TEST_F(BagOptions, TimesThatNoClockHasAreRefused) {
  std::string bytes;
  McapWriter writer([&](std::string_view piece) { bytes += piece; }, {.isChunked = false});
  const auto schema = writer.addSchema(ros2::Odometry::kType, "ros2msg", "");
  writer.write(writer.addChannel(schema, "/odom", "cdr", {}), std::uint64_t{1} << 63,
               toCdr(odometryAt(kSecond, 1, 0)));
  writer.finish();
  folder_.write("run.mcap", bytes);
  EXPECT_EQ(errorOf("mcap:" + path() + "?stamps=log"),
            path() +
                ": topic /odom: found a time of 9223372036854775808 ns, expected 2^62 at "
                "most");
}

TEST_F(BagOptions, AScannersStepAndRangeAreThoseOfAScanner) {
  for (const float step : {1e30F, 7.0F, -7.0F, 0.0F, 1e-36F, std::nanf("")}) {
    LaserScan scan = scanOf(0, "laser", {1.0F, 2.0F, 3.0F});
    scan.angleIncrement = step;
    EXPECT_NE(complaint("/scan", scan).find("rad apart, expected at least one, within a turn"),
              std::string::npos)
        << step;
  }
  for (const float range : {-1.0F, 0.0F, 1e30F}) {
    LaserScan scan = scanOf(kSecond, "base_link", {1.0F});
    scan.rangeMax = range;
    BagMaker maker;
    maker.add("/scan", scan);
    const std::string bag = write(maker);
    const std::string remark = makeSource(bag)->remark();
    EXPECT_NE(remark.find("m: it was taken as 30 m; the option max_range_m sets it"), bag.npos)
        << range << " " << remark;
    EXPECT_EQ(makeSource(bag + "?max_range_m=8")->remark(), "");
  }
  LaserScan later = scanOf(2 * kSecond, "laser", {1.0F, 2.0F, 3.0F});
  later.angleIncrement = 1e30F;
  BagMaker maker;
  maker.add("/odom", odometryAt(0, 0, 0))
      .add("/scan", scanOf(kSecond, "laser", {1.0F, 2.0F, 3.0F}));
  maker.add("/scan", later);
  const auto source = makeSource(write(maker));
  EXPECT_EQ(only(readAll(*source), "laser/LRF/scan").size(), 1u);
  EXPECT_NE(source->remark().find("1 messages of /scan reach beyond the angles of its first one"),
            std::string::npos);
}

TEST_F(BagOptions, ScannersThatDoNotSayTheirRangeSee30Metres) {
  LaserScan scan = scanOf(kSecond, "base_link", {29.5F, 31.0F});
  scan.rangeMax = 0.0F;
  BagMaker maker;
  maker.add("/scan", scan);
  const std::string bag = write(maker);
  EXPECT_EQ(asText(readAll(bag)), (Texts{"1000000 laser/LRF/scan 29500 30001"}));
  EXPECT_NE(makeSource(bag)->robotToml().find("max_range_m = 30.0\n"), std::string::npos);
  EXPECT_EQ(asText(readAll(bag + "?max_range_m=4")), (Texts{"1000000 laser/LRF/scan 4001 4001"}));
}

TEST_F(BagOptions, RangesAreSonarsWithTheirConeAndMount) {
  BagMaker maker;
  maker.add("/odom", odometryAt(0, 0, 0))
      .add("/tf_static", frameAt("base_footprint", "sonar", {{0.2, 0.1, 0.5}, {0, 0, 1, 0}}));
  maker.add("/us/left", rangeOf(kSecond, 1.25F)).add("/us/left", rangeOf(2 * kSecond, -1.0F));
  maker.add("/us/left", rangeOf(3 * kSecond, 4.0F));
  ros2::Range near = rangeOf(4 * kSecond, 0.15F);
  near.minRange = 0.2F;
  maker.add("/us/left", near);
  const auto source = makeSource(write(maker));
  EXPECT_EQ(
      asText(only(readAll(*source), "sonar/ultrasonic/us_left_0")),
      (Texts{"1000000 sonar/ultrasonic/us_left_0 1250", "2000000 sonar/ultrasonic/us_left_0 0",
             "3000000 sonar/ultrasonic/us_left_0 4001", "4000000 sonar/ultrasonic/us_left_0 0"}));
  const std::string toml = source->robotToml();
  EXPECT_NE(toml.find("feature = \"us_left_\"\npose = { x_m = 0.2, y_m = 0.1, theta_deg = 180.0 }\n"
                      "ring_radius_m = 0.0\nopening_deg = 28.64789\nmax_range_m = 4.0\n"),
            toml.npos)
      << toml;
  EXPECT_EQ(only(readAll("mcap:" + path() + "?ranges=none"), "sonar/ultrasonic/us_left_0").size(),
            0u);
}

TEST_F(BagOptions, RangesOfImpossibleConesAreRefused) {
  for (const auto& [maxRange, cone] :
       {std::pair{100.5F, 0.5F}, {0.0F, 0.5F}, {4.0F, 3.5F}, {4.0F, 0.0F}})
    EXPECT_NE(
        complaint("/us", rangeOf(0, 1.0F, maxRange, cone)).find("expected up to 3 rad and 100 m"),
        std::string::npos)
        << maxRange << " " << cone;
  EXPECT_EQ(complaint("/us", rangeOf(0, 1.0F, 100.0F, 2.9F)), "");
}

// Rows may be longer than their pixels; blue comes first in bgr8.
TEST_F(BagOptions, PicturesAreTakenIfTheyAreAskedFor) {
  BagMaker maker;
  maker.add("/odom", odometryAt(0, 0, 0))
      .add("/image", imageOf("bgr8", 2, 2, 7, {1, 2, 3, 4, 5, 6, 0, 7, 8, 9, 10, 11, 12, 0}));
  const std::string bag = write(maker);
  EXPECT_EQ(readAll(bag).size(), 1u) << "pictures are large";
  const auto pictures = only(readAll(bag + "?images=/image"), "image/camera/image");
  ASSERT_EQ(pictures.size(), 1u);
  ImageData data({"image", "camera", "image"}, {});
  data.setData(0, pictures[0].words);
  const ImageView view = data.reading();
  EXPECT_EQ(view.size.width, 2);
  EXPECT_EQ(view.size.height, 2);
  EXPECT_EQ(std::vector<int>(view.pixels, view.pixels + view.bytes()),
            (std::vector<int>{3, 2, 1, 6, 5, 4, 9, 8, 7, 12, 11, 10}));
}

TEST_F(BagOptions, PicturesOfOtherSizesThanTheySayAreRefused) {
  const std::string images = "?images=/image";
  EXPECT_EQ(complaint("/image", imageOf("mono8", 2, 2, 2, {1, 2, 3, 4}), images), "");
  EXPECT_EQ(complaint("/image", imageOf("yuv422", 2, 2, 4, std::vector<std::uint8_t>(8)), images),
            "topic /image: found pictures in 'yuv422', expected rgb8, bgr8 or mono8; the option "
            "images leaves them out");
  for (const Image& image :
       {imageOf("mono8", 0, 2, 2, {1, 2, 3, 4}), imageOf("mono8", 2, 0, 2, {1, 2, 3, 4}),
        imageOf("mono8", 2, 2, 1, {1, 2, 3, 4}), imageOf("mono8", 2, 2, 2, {1, 2, 3}),
        imageOf("rgb8", 1, 1, 2, {1, 2}),
        imageOf("mono8", 4097, 1, 4097, std::vector<std::uint8_t>(4097))})
    EXPECT_NE(complaint("/image", image, images)
                  .find("expected as many as it has, and 4096 x 4096 at most"),
              std::string::npos)
        << image.width << " x " << image.height;
}

TEST_F(BagOptions, MapsLieOnTheFloorAndAreComplete) {
  OccupancyGrid map;
  map.resolution = 0.5F;
  map.width = 2;
  map.height = 1;
  map.data = {0, 100};
  EXPECT_EQ(complaint("/map", map), "found no reading, expected at least one");
  const auto refused = [&](const OccupancyGrid& wrong) {
    return complaint("/map", wrong).find("expected a value a cell, lying on the floor") !=
           std::string::npos;
  };
  OccupancyGrid turned = map;
  for (const Quaternion& q : {Quaternion{0, 0, 0.1, 1}, {0, 0, -3, 0}, {0, 0, 0, 0}}) {
    turned.origin.orientation = q;
    EXPECT_EQ(complaint("/map", turned), "found no reading, expected at least one");
  }
  for (const Quaternion& q : {Quaternion{0.1, 0, 0, 1},
                              {0, 0.1, 0.5, 1},
                              {1, 0, 0, 0},
                              {1e-300, 0, 0, 0},
                              {0, 0, std::nan(""), 1}}) {
    turned.origin.orientation = q;
    EXPECT_TRUE(refused(turned)) << q.x << " " << q.y << " " << q.z << " " << q.w;
  }
  OccupancyGrid fine = map;
  fine.resolution = 0.0F;
  EXPECT_TRUE(refused(fine));
  fine.resolution = std::numeric_limits<float>::infinity();
  EXPECT_TRUE(refused(fine));
  fine.resolution = 101.0F;
  EXPECT_TRUE(refused(fine));
  OccupancyGrid empty = map;
  empty.width = 0;
  EXPECT_TRUE(refused(empty));
  OccupancyGrid lost = map;
  for (const double x : {std::nan(""), 1e300}) {
    lost.origin.position.x = x;
    EXPECT_TRUE(refused(lost)) << x;
  }
}

TEST_F(BagOptions, OfSeveralMapsTheFirstOrTheNamedOneBecomesTheWorld) {
  OccupancyGrid map;
  map.resolution = 0.5F;
  map.width = map.height = 1;
  map.data = {65};
  OccupancyGrid other = map;
  other.data = {26};
  OccupancyGrid beyond = map;
  beyond.data = {101};
  BagMaker maker;
  maker.add("/odom", odometryAt(0, 0, 0)).add("/map", map).add("/local", other);
  maker.add("/beyond", beyond);
  const std::string bag = write(maker);
  const auto cellOf = [&](const std::string& options) {
    makeSource(bag + options)->writeWorld(folder_.path() / "w.toml");
    return static_cast<unsigned char>(readBytes(folder_.path() / "w.pgm").back());
  };
  EXPECT_EQ(cellOf(""), 0) << "65 and more are occupied";
  EXPECT_EQ(cellOf("?map=/local"), 205) << "26 to 64 are unknown";
  EXPECT_EQ(cellOf("?map=/beyond"), 205) << "more than 100 % are unknown";
  EXPECT_EQ(errorOf([&] { cellOf("?map=/none"); }),
            path() +
                ": found no message at the topic '/none' that the option map names, expected "
                "one with nav_msgs/msg/OccupancyGrid: '/beyond', '/local', '/map'");
}

TEST_F(BagOptions, MessagesThatAreCutOffNameTheirTopic) {
  std::string bytes;
  McapWriter writer([&](std::string_view piece) { bytes += piece; }, {.isChunked = false});
  const auto schema = writer.addSchema(LaserScan::kType, "ros2msg", "");
  const std::string whole = toCdr(scanOf(0, "laser", {1.0F}));
  writer.write(writer.addChannel(schema, "/scan", "cdr", {}), 1, whole.substr(0, 20));
  writer.finish();
  folder_.write("run.mcap", bytes);
  const std::string error = errorOf("mcap:" + path());
  EXPECT_TRUE(error.starts_with(path() + ": topic /scan: found ")) << error;
  EXPECT_TRUE(error.ends_with(", expected a sensor_msgs/msg/LaserScan")) << error;
}

// A robot file within the file is the one with which it was recorded.
TEST_F(BagOptions, TheRobotFileOfARecordIsKept) {
  std::string bytes;
  McapWriter writer([&](std::string_view piece) { bytes += piece; }, {});
  const auto schema = writer.addSchema(ros2::Odometry::kType, "ros2msg", "");
  const auto channel =
      writer.addChannel(schema, "/odom", "cdr", {{"ortung_feature", "w/odometry/p"}});
  writer.attach("robot.toml", "application/toml", "[robot]\nname = \"mine\"\n");
  writer.attach("notes.txt", "text/plain", "[robot]\n");
  writer.write(channel, 1, toCdr(odometryAt(kSecond, 1, 0)));
  writer.finish();
  folder_.write("run.mcap", bytes);
  const auto source = makeSource("mcap:" + path());
  EXPECT_EQ(source->robotToml(), "[robot]\nname = \"mine\"\n");
  EXPECT_EQ(toText(readAll(*source).at(0).id), "w/odometry/p");
}

TEST_F(BagOptions, AnUnfinishedFileIsReadAndToldOf) {
  BagMaker maker;
  maker.add("/odom", odometryAt(kSecond, 1, 0));
  const std::string whole = maker.bytes();
  using namespace std::string_literals;
  const std::size_t dataEnd = whole.rfind("\x0F\x04\0\0\0\0\0\0\0"s);
  ASSERT_NE(dataEnd, whole.npos);
  folder_.write("run.mcap", whole.substr(0, dataEnd));
  const auto source = makeSource("mcap:" + path());
  EXPECT_EQ(readAll(*source).size(), 1u);
  EXPECT_EQ(source->remark(), path() + " is unfinished; it was read up to its end");
}

TEST_F(BagOptions, AFolderWithoutFilesIsNoBag) {
  EXPECT_EQ(
      errorOf("mcap:" + folder_.path().string()),
      folder_.path().string() +
          ": found no file *.mcap, *.db3, *.zstd or *.bag in this folder, expected those of a bag");
}

// Scanners lean by 11 degrees at most: the cosine of 11.48 degrees is 0.98.
TEST_F(BagOptions, AScannerMayLeanALittle) {
  const auto leaning = [&](double degrees) {
    const double half = degrees * M_PI / 360;
    BagMaker maker;
    maker.add("/odom", odometryAt(0, 0, 0))
        .add("/tf_static", frameAt("base_footprint", "laser",
                                   {{0, 0, 0}, {0, std::sin(half), 0, std::cos(half)}}))
        .add("/scan", scanOf(0, "laser", {1.0F, 2.0F, 3.0F}));
    return errorOf(write(maker));
  };
  EXPECT_EQ(leaning(11.4), "");
  EXPECT_EQ(leaning(11.6), path() +
                               ": the scanner of /scan is tilted by 11 degrees, expected a "
                               "level one; the option scans leaves it out");
  EXPECT_EQ(leaning(170), "") << "upside down";
}

// Clockwise beams are turned round, and those of a scanner upside down are turned round twice.
TEST_F(BagOptions, ClockwiseScansAreTurnedRound) {
  LaserScan scan = scanOf(kSecond, "laser", {1.0F, 2.0F, 3.0F});
  scan.angleMin = 0.5F;
  scan.angleIncrement = -0.5F;
  for (const bool isUpsideDown : {false, true}) {
    BagMaker maker;
    maker.add("/odom", odometryAt(0, 0, 0))
        .add("/tf_static",
             frameAt("base_footprint", "laser",
                     {{0, 0, 0}, isUpsideDown ? Quaternion{1, 0, 0, 0} : Quaternion{}}))
        .add("/scan", scan);
    EXPECT_EQ(asText(only(readAll(write(maker)), "laser/LRF/scan")),
              (Texts{isUpsideDown ? "1000000 laser/LRF/scan 1000 2000 3000"
                                  : "1000000 laser/LRF/scan 3000 2000 1000"}));
  }
}

}  // namespace
}  // namespace ortung

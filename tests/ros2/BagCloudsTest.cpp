// Clouds of lidars in bags, as scans of the source `mcap`.
#include <cmath>
#include <numbers>

#include "BagMaker.hpp"
#include "CloudMaker.hpp"
#include "LogTesting.hpp"

namespace ortung {
namespace {

using namespace ortung::testing;
using namespace ros2;
using Texts = std::vector<std::string>;

const std::string kLidar = "lidar/LRF/scan";

/// The orientation of roll and pitch.
Quaternion leaning(double roll, double pitch) {
  const double cr = std::cos(roll / 2), sr = std::sin(roll / 2);
  const double cp = std::cos(pitch / 2), sp = std::sin(pitch / 2);
  return {sr * cp, cr * sp, -sr * sp, cr * cp};
}

class BagClouds : public ::testing::Test {
 protected:
  /// A bag with odometry and a lidar that is 0.2 m ahead and 0.5 m above the robot's frame.
  BagClouds() {
    maker_.add("/odom", odometryAt(kSecond, 0, 0))
        .add("/tf_static", frameAt("base_footprint", "lidar", {{0.2, 0, 0.5}, {}}));
  }
  std::string write() { return "mcap:" + folder_.write("run.mcap", maker_.bytes()).string(); }
  std::string path() const { return (folder_.path() / "run.mcap").string(); }
  /// Words of the beams 0, 90, 180 and 270 of the only scan: behind, right, ahead, left.
  static std::vector<std::uint32_t> cross(const std::vector<Message>& messages,
                                          const std::string& feature = kLidar) {
    const auto scans = only(messages, feature);
    EXPECT_EQ(scans.size(), 1u);
    if (scans.size() != 1 || scans[0].words.size() != 360) return {};
    const auto& words = scans[0].words;
    return {words[0], words[90], words[180], words[270]};
  }
  static bool has(const std::string& text, const std::string& part) {
    return text.find(part) != text.npos;
  }
  BagMaker maker_;
  TemporaryFolder folder_;
};

/// Walls 2 m behind, 3 m to the right, 4 m ahead and 5 m to the left of the lidar, at its height.
const std::vector<CloudPoint> kWalls{{-2, 0, 0}, {0, -3, 0}, {4, 0, 0}, {0, 5, 0}};
using Words4 = std::vector<std::uint32_t>;

TEST_F(BagClouds, BecomeAScannerAllAroundAtTheLidarsPlace) {
  maker_.add("/points", cloudOf(kWalls, {}, kSecond));
  const auto source = makeSource(write());
  EXPECT_EQ(cross(readAll(*source)), (Words4{2000, 3000, 4000, 5000}));
  const std::string toml = source->robotToml();
  EXPECT_TRUE(has(toml,
                  "model = \"lidar\"\ntype = \"LRF\"\nfeature = \"scan\"\n"
                  "pose = { x_m = 0.2, y_m = 0.0, theta_deg = 0.0 }\nbeams = 360\n"
                  "first_angle_deg = -180.0\nangle_step_deg = 1.0\nmax_range_m = 30.0\n"))
      << toml;
  EXPECT_EQ(source->remark(), "");
}

// The mount is told after the cloud, in a frame that is looked up through another one.
TEST_F(BagClouds, TheMountMayBeTiltedAndToldLater) {
  const double half = std::sqrt(0.5);
  std::vector<CloudPoint> turned;
  for (const CloudPoint& p : kWalls) turned.push_back({-p.z, p.y, p.x});  // pitched by 90 degrees
  maker_.add("/points", cloudOf(turned, {}, kSecond, "tilted"))
      .add("/tf_static", frameAt("lidar", "tilted", {{}, {0, half, 0, half}}));
  EXPECT_EQ(cross(readAll(write())), (Words4{2000, 3000, 4000, 5000}));
}

TEST_F(BagClouds, AreReadByDefaultOnlyWhereThereAreNoScans) {
  maker_.add("/points", cloudOf(kWalls, {}, kSecond))
      .add("/scan", scanOf(kSecond, "lidar", {1, 2, 3}));
  const std::string bag = write();
  EXPECT_TRUE(only(readAll(bag), kLidar).empty());
  EXPECT_EQ(cross(readAll(bag + "?clouds=/points")), (Words4{2000, 3000, 4000, 5000}));
  EXPECT_EQ(readAll(bag + "?clouds=/points&scans=none").size(), 2u);
  EXPECT_TRUE(has(errorOf(bag + "?clouds=/other"),
                  "found no message at the topic '/other' that the option clouds names, expected "
                  "one with sensor_msgs/msg/PointCloud2: '/points'"));
}

TEST_F(BagClouds, EachLidarIsAScannerOfItsOwnWithItsOwnBand) {
  maker_.add("/front/points", cloudOf({{4, 0, 0}, {3, 0, 0.8}}, {}, kSecond))
      .add("/top", cloudOf({{4, 0, 0}, {3, 0, 0.8}}, {}, kSecond));
  const std::string bag = write();
  EXPECT_EQ(cross(readAll(bag), "front_points/LRF/scan")[2], 3000u);
  EXPECT_EQ(cross(readAll(bag), "top/LRF/scan")[2], 3000u);
  const auto messages = readAll(bag + "?band=/top:0.2,1.0");
  EXPECT_EQ(cross(messages, "front_points/LRF/scan")[2], 3000u);
  EXPECT_EQ(cross(messages, "top/LRF/scan")[2], 4000u);
  EXPECT_EQ(cross(readAll(bag + "?band=0.2,1.0"), "front_points/LRF/scan")[2], 4000u);
  EXPECT_TRUE(has(errorOf(bag + "?band=/side:0,1"), "'/side' that the option band names"));
  EXPECT_TRUE(has(errorOf(bag + "?band=2,1"), "must be below the greatest"));
  EXPECT_EQ(only(readAll(bag + "?clouds=/top&cloud_beams=8"), kLidar).at(0).words,
            (std::vector<std::uint32_t>{0, 0, 0, 0, 3000, 0, 0, 0}));
  EXPECT_EQ(only(readAll(bag + "?clouds=/top&cloud_beams=8&cloud_min_range_m=3.5"), kLidar)
                .at(0)
                .words.at(4),
            4000u);
}

TEST_F(BagClouds, WhereTheLidarSitsHasToBeKnown) {
  maker_.add("/points", cloudOf(kWalls, {}, kSecond, "elsewhere"));
  const std::string bag = write();
  const auto source = makeSource(bag);
  EXPECT_TRUE(only(readAll(*source), kLidar).empty());
  EXPECT_TRUE(has(source->remark(),
                  "the mount of frame 'elsewhere' of /points in "
                  "'base_footprint' is not known: its clouds were left out"))
      << source->remark();
  EXPECT_TRUE(has(errorOf(bag + "?clouds=/points"), "expected it at /tf_static, or in the option"));
  const std::string told = bag + "?clouds=/points&mounts=elsewhere:0.2,0,";
  EXPECT_EQ(cross(readAll(told + "0,0.5")), (Words4{2000, 3000, 4000, 5000}));
  EXPECT_EQ(cross(readAll(told + "90,0.5")), (Words4{5000, 2000, 3000, 4000}));
  EXPECT_EQ(cross(readAll(told + "0,0.5,180,0")), (Words4{2000, 5000, 4000, 3000}));
}

// By 10 degrees to the left, and by 5 ahead: 20 cm below the lidar are then elsewhere.
TEST_F(BagClouds, AreLevelledByAnInertialUnitOrByOdometry) {
  const Quaternion lean = leaning(0.2, 0.0);
  Imu imu;
  imu.header = {kSecond, "imu"};
  imu.orientation = lean;
  Odometry odometry = odometryAt(kSecond, 0, 0);
  odometry.pose.orientation = lean;
  // A wall 5 m to the left, which a robot that leans to the right sees too low by 1 m, and the
  // floor to the right, 2 m away, which it sees in the heights of a wall.
  const double c = std::cos(0.2), s = std::sin(0.2);
  const auto seen = [&](double y, double z) {  // of the level frame, as the lidar has it
    return CloudPoint{-0.2, y * c + z * s, -y * s + z * c - 0.5};
  };
  maker_.add("/points", cloudOf({seen(5, 0.5), seen(-2, 0.0)}, {}, kSecond))
      .add("/imu", imu)
      .add("/leaning", odometry);
  const std::string bag = write();
  const auto leftAndRight = [&](const std::string& options) {
    const auto words = only(readAll(bag + options), kLidar).at(0).words;
    std::pair<std::uint32_t, std::uint32_t> nearest{0, 0};
    for (std::size_t i = 0; i < words.size(); ++i) {
      if (words[i] == 0) continue;
      (i < 180 ? nearest.second : nearest.first) = words[i];
    }
    return nearest;
  };
  const auto right = leftAndRight("?level=none").second;
  EXPECT_NEAR(right, 2000.0, 60.0) << "the floor";
  for (const char* options : {"?level=/imu", "?odometry=/leaning"}) {
    const auto [left, floor] = leftAndRight(options);
    // The lidar's place in the plane is that of a robot that stands upright.
    EXPECT_NEAR(left, 5000.0, 15.0) << options;
    EXPECT_EQ(floor, 0u) << options;
  }
  EXPECT_TRUE(
      has(makeSource(bag + "?level=/imu")->remark(), "how the frame 'imu' of /imu lies in "));
  EXPECT_TRUE(has(errorOf(bag + "?level=/odom"), "that the option level names"));
}

TEST_F(BagClouds, AnAttitudeThatIsNoneIsTold) {
  Imu imu;
  imu.header = {kSecond, "lidar"};
  imu.orientationCovariance[0] = -1;
  maker_.add("/imu", imu).add("/points", cloudOf(kWalls, {}, kSecond));
  const auto source = makeSource(write() + "?level=/imu");
  EXPECT_TRUE(has(source->remark(), "1 messages of /imu have no orientation, and were left out"))
      << source->remark();
  EXPECT_TRUE(has(source->remark(),
                  "1 messages of clouds have no attitude of their time at /imu, and were not "
                  "levelled"));
}

// At 2 m/s the wall ahead is seen 10 cm nearer at the end of the sweep than at its beginning.
TEST_F(BagClouds, TheMotionDuringTheSweepIsThatOfOdometryOrOfFrames) {
  CloudForm form;
  form.fields.push_back({"time", 16, CloudForm::Field::kFloat, 1});
  form.pointStep = 20;
  maker_.add("/fast", odometryAt(kSecond, 0, 2.0))
      .add("/tf", frameAt("odom", "base_footprint", {{0, 0, 0}, {}}, kSecond * 8 / 10))
      .add("/tf", frameAt("odom", "base_footprint", {{0.4, 0, 0}, {}}, kSecond))
      .add("/points", cloudOf({{3.9, 0, 0, 0.05}, {0, -3, 0, 0.0}}, form, kSecond));
  const std::string bag = write();
  EXPECT_EQ(cross(readAll(bag))[2], 3900u) << "the first odometry stands still";
  EXPECT_EQ(cross(readAll(bag + "?odometry=/fast"))[2], 4000u);
  EXPECT_EQ(cross(readAll(bag + "?odometry=tf"))[2], 4000u);
}

TEST_F(BagClouds, CloudsThatAreNoneAreRefusedOrLeftOut) {
  PointCloud broken = cloudOf(kWalls, {}, 2 * kSecond);
  broken.width = 5;
  PointCloud empty = cloudOf({{0, 0, 5}}, {}, 3 * kSecond);
  maker_.add("/points", cloudOf(kWalls, {}, kSecond)).add("/points", broken).add("/points", empty);
  const auto source = makeSource(write());
  EXPECT_EQ(only(readAll(*source), kLidar).size(), 1u);
  EXPECT_TRUE(has(source->remark(), "1 messages of /points have fields or sizes that their bytes"))
      << source->remark();
  EXPECT_TRUE(has(source->remark(), "1 messages of /points have no point in the band"));
  BagMaker bad;
  bad.add("/odom", odometryAt(kSecond, 0, 0))
      .add("/tf_static", frameAt("base_footprint", "lidar", {{0.2, 0, 0.5}, {}}))
      .add("/points", broken);
  EXPECT_EQ(errorOf("mcap:" + folder_.write("bad.mcap", bad.bytes()).string()),
            (folder_.path() / "bad.mcap").string() +
                ": topic /points: found 1 rows of 5 points of 16 bytes, 80 bytes apart, in 64 "
                "bytes of data, expected as many as they take");
}

}  // namespace
}  // namespace ortung

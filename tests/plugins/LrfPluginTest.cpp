#include <cmath>
#include <numbers>

#include "FakeWorld.hpp"
#include "SensorRig.hpp"
#include "ortung/formats/ScanData.hpp"

namespace ortung {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;  // [rad]
constexpr double kMillimetre = 0.00051;               // words round to the nearest [m]

TEST(LrfPlugin, MakesOneScanOfBeamsFromEdgeToEdge) {
  SensorRig rig("lrf", "");
  ASSERT_EQ(rig.data.size(), 1u);
  EXPECT_EQ(toText(rig.data[0]->id()), "LMS200/LRF/180DegreeScan");
  const ScanData::Config& scan = rig.get<ScanData>().config();
  EXPECT_EQ(scan.beams, 180);
  EXPECT_NEAR(scan.firstAngle, -90.0 * kDegree, 1e-12);
  EXPECT_NEAR(scan.firstAngle + 179 * scan.angleStep, 90.0 * kDegree, 1e-12);
}

TEST(LrfPlugin, TakesNamesPoseAndBeamsFromTheSettings) {
  SensorRig rig("lrf",
                "model = 'LMS111'\ntype = 'laser'\nfeature = 'front'\nbeams = 3\n"
                "first_angle_deg = 10\nangle_step_deg = 5\n"
                "pose = { x_m = 0.1, y_m = -0.2, z_m = 0.4, theta_deg = 90 }");
  EXPECT_EQ(toText(rig.data[0]->id()), "LMS111/laser/front");
  EXPECT_NEAR(rig.data[0]->mount().x, 0.1, 1e-12);
  EXPECT_NEAR(rig.data[0]->mount().y, -0.2, 1e-12);
  EXPECT_NEAR(rig.data[0]->mount().theta, 90.0 * kDegree, 1e-12);
  EXPECT_NEAR(rig.get<ScanData>().config().firstAngle, 10.0 * kDegree, 1e-12);
  EXPECT_NEAR(rig.get<ScanData>().config().angleStep, 5.0 * kDegree, 1e-12);
}

TEST(LrfPlugin, DoesNotRepeatTheFirstBeamAllAround) {
  SensorRig rig("lrf", "beams = 360\nfov_deg = 360");
  EXPECT_NEAR(rig.get<ScanData>().config().angleStep, 1.0 * kDegree, 1e-12);
}

TEST(LrfPlugin, RefusesWrongSettingsByName) {
  expectRefusal("lrf", "max_rang_m = 8", {"test.toml", "max_rang_m"});
  expectRefusal("lrf", "beams = 0", {"beams", "0", "8192"});
  expectRefusal("lrf", "beams = 'many'", {"beams"});
  expectRefusal("lrf", "fov_deg = 400", {"fov_deg", "400", "360"});
  expectRefusal("lrf", "fov_deg = 180\nangle_step_deg = 1", {"fov_deg", "angle_step_deg"});
  expectRefusal("lrf", "beams = 100\nangle_step_deg = 4", {"angle_step_deg", "3.6"});
  expectRefusal("lrf", "beams = 10\nfov_deg = 350", {"fov_deg", "350", "324"});
  expectRefusal("lrf", "max_range_m = -1", {"max_range_m", "-1"});
  expectRefusal("lrf", "min_range_m = 9", {"min_range_m", "9", "8"});
  expectRefusal("lrf", "perception = 'magic'", {"perception", "magic", "rays", "endpoints"});
  expectRefusal("lrf", "dropout_share = 1.5", {"dropout_share", "1.5"});
  expectRefusal("lrf", "pose = { x = 1 }", {"x"});
}

TEST(LrfPlugin, MeasuresARoomAsGeometryDoes) {
  FakeWorld room(6.0, 4.0);
  room.addPost({1.0, 0.5, 0.1});
  SensorRig rig("lrf", "pose = { x_m = 0.2, y_m = 0.1, theta_deg = 30 }");
  const Pose2 robot{-0.7, 0.3, 1.1};
  rig.sense(room, robot);
  // The sensor's place by hand, from the robot's pose and its mount.
  const double x = robot.x + 0.2 * std::cos(1.1) - 0.1 * std::sin(1.1);
  const double y = robot.y + 0.2 * std::sin(1.1) + 0.1 * std::cos(1.1);
  const ScanData::Reading scan = rig.get<ScanData>().reading();
  for (int i = 0; i < 180; ++i) {
    const double angle = 1.1 + (30.0 - 90.0 + i * 180.0 / 179.0) * kDegree;
    EXPECT_NEAR(scan.ranges[static_cast<std::size_t>(i)], room.range(x, y, angle), kMillimetre)
        << i;
  }
}

TEST(LrfPlugin, SeesNothingBeyondItsRange) {
  const FakeWorld room(40.0, 2.0);
  SensorRig rig("lrf", "beams = 3\nfov_deg = 180\nmax_range_m = 8");
  rig.sense(room, {0.0, 0.0, 0.0});
  const ScanData::Reading scan = rig.get<ScanData>().reading();
  EXPECT_NEAR(scan.ranges[0], 1.0, kMillimetre);
  EXPECT_TRUE(std::isinf(scan.ranges[1]));
  Random noise(1);
  rig.sense(room, {0.0, 0.0, 0.0}, &noise);
  EXPECT_TRUE(std::isinf(rig.get<ScanData>().reading().ranges[1]));
}

TEST(LrfPlugin, LearnsTheSmallestRangeWhereItCouldNotMeasure) {
  const FakeWorld room(40.0, 0.4);
  SensorRig rig("lrf", "beams = 1\nmin_range_m = 0.5004\npose = { theta_deg = 90 }");
  rig.sense(room, {});
  EXPECT_NEAR(rig.get<ScanData>().reading().ranges[0], 0.5004, 0.0011);
  Random noise(1);
  rig.sense(room, {}, &noise);
  EXPECT_TRUE(std::isnan(rig.get<ScanData>().reading().ranges[0]));
}

TEST(LrfPlugin, HasTheNoiseOfItsModel) {
  const FakeWorld room(8.0, 8.0);
  SensorRig rig("lrf", "beams = 1\nsigma_m = 0.03\nsigma_per_m = 0.01");
  Random noise(7);
  Statistics ranges;
  for (int i = 0; i < 4000; ++i) {
    rig.sense(room, {}, &noise);
    ranges.add(static_cast<double>(rig.get<ScanData>().reading().ranges[0]));
  }
  // sigma(4 m) = 0.07 m; the mean of 4000 is within 4 * 0.07 / sqrt(4000), sigma within 5 %.
  EXPECT_NEAR(ranges.mean(), 4.0, 0.0045);
  EXPECT_NEAR(ranges.sigma(), 0.07, 0.0035);
}

TEST(LrfPlugin, LosesTheShareOfBeamsThatWasAskedFor) {
  const FakeWorld room(8.0, 8.0);
  SensorRig rig("lrf", "dropout_share = 0.2\nnoise_sigma_m = 0\nnoise_sigma_per_m = 0");
  Random noise(3);
  int lost = 0;
  for (int i = 0; i < 50; ++i) {
    rig.sense(room, {0.5, 0.5, 0.1 * i}, &noise);
    for (const float range : rig.get<ScanData>().reading().ranges)
      lost += std::isnan(range) ? 1 : 0;
  }
  EXPECT_NEAR(lost / 9000.0, 0.2, 0.017);  // 4 sigma of 9000 draws
}

TEST(LrfPlugin, GivesTheSameBitsForTheSameSeed) {
  const FakeWorld room(8.0, 8.0);
  SensorRig one("lrf", "dropout_share = 0.1");
  SensorRig other("lrf", "dropout_share = 0.1");
  Random noise(11);
  Random again(11);
  one.sense(room, {1.0, 0.0, 0.3}, &noise);
  other.sense(room, {1.0, 0.0, 0.3}, &again);
  EXPECT_TRUE(std::ranges::equal(one.data[0]->getData(), other.data[0]->getData()));
}

}  // namespace
}  // namespace ortung

#include <algorithm>
#include <cmath>
#include <numbers>

#include "FakeWorld.hpp"
#include "SensorRig.hpp"
#include "ortung/formats/ObstaclesData.hpp"
#include "ortung/formats/PoseFixData.hpp"

namespace ortung {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kDegree = kPi / 180.0;  // [rad]

/// A room of 8 x 5 m whose walls are known.
FakeWorld room() {
  FakeWorld world(8.0, 5.0);
  world.addWallsOfRoom();
  return world;
}

constexpr const char* kAround =
    "beams = 360\nfov_deg = 360\nmax_range_m = 12\npose = { x_m = 0.1, y_m = 0.05, theta_deg = 20 "
    "}";

/// The fix that is nearest to the truth.
PoseFixData::Fix nearest(const PoseFixData::Reading& fixes, const Pose2& truth) {
  return *std::min_element(fixes.begin(), fixes.end(), [&](const auto& a, const auto& b) {
    return distance(a.pose, truth) < distance(b.pose, truth);
  });
}

TEST(LrfIconicPlugin, RefusesWrongSettingsByName) {
  expectRefusal("lrf_iconic", "feature = 'x'", {"feature", "obstacles"});
  expectRefusal("lrf_iconic", "braek_m = 1", {"braek_m"});
  expectRefusal("lrf_iconic", "line_tolerance_m = 0", {"line_tolerance_m"});
  expectRefusal("lrf_iconic", "most_positions = 0", {"most_positions"});
  expectRefusal("lrf_iconic", "beams = 1000000", {"beams"});
}

TEST(LrfIconicPlugin, FindsWhereItIsInARoomUpToItsSymmetry) {
  const FakeWorld world = room();
  SensorRig rig("lrf_iconic", kAround);
  for (const Pose2 robot : {Pose2{0.5, 0.3, 0.4}, Pose2{-2.8, 1.2, -2.5}, Pose2{3.0, -1.6, 3.0}}) {
    rig.sense(world, robot);
    const PoseFixData::Reading& fixes = rig.get<PoseFixData>(1).reading();
    ASSERT_EQ(fixes.size(), 2u);  // all walls in sight: itself and half a turn off
    for (const Pose2& place : {robot, Pose2{-robot.x, -robot.y, wrapAngle(robot.theta + kPi)}}) {
      const PoseFixData::Fix fix = nearest(fixes, place);
      EXPECT_NEAR(fix.pose.x, place.x, 0.003);
      EXPECT_NEAR(fix.pose.y, place.y, 0.003);
      EXPECT_NEAR(wrapAngle(fix.pose.theta - place.theta), 0.0, 0.1 * kDegree);
    }
    EXPECT_TRUE(rig.get<ObstaclesData>(0).reading().empty());  // walls are none
  }
}

TEST(LrfIconicPlugin, ItsCovarianceIsThatOfItsErrors) {
  const FakeWorld world = room();
  SensorRig rig("lrf_iconic", std::string(kAround) + "\nnoise_sigma_m = 0.03");
  const Pose2 robot{1.0, 0.7, 0.3};
  Random noise(3);
  Statistics dx;
  Statistics dTheta;
  double sigmaX = 0.0;
  double sigmaTheta = 0.0;
  constexpr int kReadings = 400;
  for (int i = 0; i < kReadings; ++i) {
    rig.sense(world, robot, &noise);
    const PoseFixData::Reading& fixes = rig.get<PoseFixData>(1).reading();
    ASSERT_FALSE(fixes.empty());
    const PoseFixData::Fix fix = nearest(fixes, robot);
    dx.add(fix.pose.x - robot.x);
    dTheta.add(wrapAngle(fix.pose.theta - robot.theta));
    sigmaX += std::sqrt(fix.covariance[0]) / kReadings;
    sigmaTheta += std::sqrt(fix.covariance[8]) / kReadings;
  }
  EXPECT_NEAR(dx.mean(), 0.0, 0.003);
  // Noise along a beam is no more than noise across the wall, so the covariance errs on the safe
  // side; sigmas of 400 draws are known to 4 / sqrt(800) = 14 %.
  EXPECT_LT(dx.sigma(), 1.2 * sigmaX);
  EXPECT_GT(dx.sigma(), 0.4 * sigmaX);
  EXPECT_LT(dTheta.sigma(), 1.2 * sigmaTheta);
  EXPECT_GT(dTheta.sigma(), 0.4 * sigmaTheta);
}

TEST(LrfIconicPlugin, TellsRoundObstaclesFromWalls) {
  FakeWorld world = room();
  world.addPost({2.0, 0.5, 0.2});
  SensorRig rig("lrf_iconic", "beams = 720\nfov_deg = 360\nmax_range_m = 12");
  rig.sense(world, {0.0, 0.0, 0.0});
  EXPECT_FALSE(rig.get<PoseFixData>(1).reading().empty());
  const ObstaclesData::Reading& obstacles = rig.get<ObstaclesData>(0).reading();
  ASSERT_EQ(obstacles.size(), 1u);
  EXPECT_EQ(obstacles[0].shape, ObstaclesData::Shape::kCircle);
  EXPECT_NEAR(obstacles[0].x, 2.0, 0.02);
  EXPECT_NEAR(obstacles[0].y, 0.5, 0.02);
  EXPECT_NEAR(obstacles[0].radius, 0.2, 0.02);
}

TEST(LrfIconicPlugin, HasTheFeaturesOfItsPage) {
  const SensorRig rig("lrf_iconic", "");
  std::string names;
  for (const auto& data : rig.data)
    names += data->id().model + "/" + data->id().type + "/" + data->id().feature + "\n";
  EXPECT_EQ(names, "LMS200/LRF/obstacles\nLMS200/LRF/position\nLMS200/LRF/scan\n");
}

// Beams are 1 degree apart: one, two or three of them meet the post.
TEST(LrfIconicPlugin, ThreePointsAreABodyAndFewerAreNoise) {
  for (const auto& [half, heading, bodies] :  // [degrees]
       {std::tuple{0.5, 0.0, 0U}, {1.2, 0.5, 0U}, {1.5, 0.0, 1U}}) {
    FakeWorld world = room();
    world.addPost({2.0, 0.0, 2.0 * std::sin(half * kDegree)});
    SensorRig rig("lrf_iconic", "beams = 360\nfov_deg = 360\nmax_range_m = 12");
    rig.sense(world, {0.0, 0.0, heading * kDegree});
    EXPECT_EQ(rig.get<ObstaclesData>(0).reading().size(), bodies) << half;
  }
}

TEST(LrfIconicPlugin, WithoutKnownWallsAllIsObstacle) {
  const FakeWorld world(8.0, 5.0);  // nobody knows its walls
  SensorRig rig("lrf_iconic", "beams = 360\nfov_deg = 360\nmax_range_m = 12");
  rig.sense(world, {0.0, 0.0, 0.0});
  EXPECT_TRUE(rig.get<PoseFixData>(1).reading().empty());
  const ObstaclesData::Reading& obstacles = rig.get<ObstaclesData>(0).reading();
  ASSERT_EQ(obstacles.size(), 4u);
  double around = 0.0;
  for (const ObstaclesData::Obstacle& o : obstacles) {
    EXPECT_EQ(o.shape, ObstaclesData::Shape::kSegment);
    around += std::hypot(o.endX - o.x, o.endY - o.y);
  }
  EXPECT_NEAR(around, 2 * (8.0 + 5.0), 0.5);  // but for a beam's gap at each corner
}

TEST(LrfIconicPlugin, OneWallIsNoPosition) {
  const FakeWorld world = room();
  SensorRig rig("lrf_iconic", "beams = 91\nfov_deg = 90\nmax_range_m = 3.5");
  rig.sense(world, {1.0, 0.0, 0.0});  // the wall ahead alone is within range
  EXPECT_TRUE(rig.get<PoseFixData>(1).reading().empty());
  EXPECT_EQ(rig.data[1]->sequence(), 1u);  // but it has looked
}

}  // namespace
}  // namespace ortung

#include <cmath>
#include <numbers>

#include "FakeWorld.hpp"
#include "SensorRig.hpp"
#include "ortung/formats/BearingData.hpp"
#include "ortung/formats/LandmarksData.hpp"
#include "ortung/formats/ObjectsData.hpp"
#include "ortung/formats/PointsData.hpp"

namespace ortung {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;  // [rad]
constexpr double kMillimetre = 0.00051;               // words round to the nearest [m]
constexpr double kAngle = 0.0051 * kDegree;           // likewise, 1/100 degree

FieldLine straight(double x0, double y0, double x1, double y1) {
  FieldLine line;
  line.x0 = x0;
  line.y0 = y0;
  line.x1 = x1;
  line.y1 = y1;
  line.width = 0.1;
  return line;
}

WorldObject round(const char* kind, const char* colour, double x, double y, double radius) {
  WorldObject object;
  object.kind = kind;
  object.colour = colour;
  object.pose = {x, y, 0};
  object.radius = object.halfX = object.halfY = radius;
  object.zHigh = 0.3;
  object.isRound = true;
  return object;
}

/// 12 x 8 m with a line at x = 3, two goals, a ball, a robot with a body.
FakeWorld field() {
  FakeWorld world(12.0, 8.0);
  world.addLine(straight(3, -4, 3, 4));
  world.addLandmark({1, "goal", -5.9, 0.0, 0.5});
  world.addLandmark({2, "goal", 5.9, 0.0, 0.5});
  world.addLandmark({1, "post", 5.0, 3.0, 0.5});
  world.addObject(round("ball", "orange", 1.0, 2.0, 0.11));
  const RobotNumber number = world.addRound(0.25, 0.0, -2.0);
  WorldObject robot = round("robot", "cyan", 0.0, -2.0, 0.25);
  robot.robot = number;
  world.addObject(robot);
  return world;
}

TEST(IconicPlugin, HasAFeatureForEachThingItSees) {
  SensorRig all("iconic_omnivision", "");
  ASSERT_EQ(all.data.size(), 6u);
  EXPECT_EQ(toText(all.data[0]->id()), "omnivision/camera/lines");
  SensorRig some("iconic_camera", "see = ['ball', 'goals', 'posts']\ngoals = {identified = false}");
  ASSERT_EQ(some.data.size(), 3u);
  EXPECT_EQ(toText(some.data[0]->id()), "webcam/camera/ball");
  EXPECT_NE(dynamic_cast<ObjectsData*>(some.data[0]), nullptr);
  EXPECT_NE(dynamic_cast<PointsData*>(some.data[1]), nullptr);
  EXPECT_NE(dynamic_cast<LandmarksData*>(some.data[2]), nullptr);
}

TEST(IconicPlugin, WhatMovesIsNeverLearned) {
  SensorRig rig("iconic_omnivision", "see = ['ball', 'robots', 'obstacles']");
  for (const SensorData* data : rig.data) EXPECT_FALSE(data->localizes()) << data->id().feature;
}

TEST(IconicPlugin, RefusesWrongSettingsByName) {
  for (const char* plugin : {"iconic_omnivision", "iconic_camera"}) {
    expectRefusal(plugin, "se = ['ball']", {"test.toml", "se"});
    expectRefusal(plugin, "see = []", {"see", "empty"});
    expectRefusal(plugin, "see = ['moon']", {"see", "moon", "goals"});
    expectRefusal(plugin, "see = ['ball', 'ball']", {"see", "ball", "twice"});
    expectRefusal(plugin, "feature = 'x'", {"feature", "see"});
    expectRefusal(plugin, "lines = { rays = 1000000000 }", {"rays", "1000000000"});
    expectRefusal(plugin, "lines = { sigma_m = 0 }", {"sigma_m"});
    expectRefusal(plugin, "goals = { identities = [] }", {"identities", "1 to 256"});
    expectRefusal(plugin, "posts = { identities = [1.5] }", {"identities", "1.5"});
    expectRefusal(plugin, "fov_deg = nan", {"fov_deg"});
    expectRefusal(plugin, "max_range_m = inf", {"max_range_m"});
    expectRefusal(plugin, "missed_share = 2", {"missed_share", "2"});
  }
  // Settings of what it is not asked to see would be settings without effect.
  expectRefusal("iconic_camera", "see = ['ball']\nlines = { rays = 3 }", {"lines"});
}

TEST(IconicPlugin, PutsPointsWhereItsScanLinesCrossLines) {
  const FakeWorld world = field();
  SensorRig rig("iconic_omnivision",
                "see = ['lines']\nlines = { rays = 36, max_range_m = 5 }\nmax_range_m = 8");
  rig.sense(world, {1.0, 0.0, 0.0});
  // x = 3 is 2 m ahead: within 5 m up to acos(2 / 5) = 66.4 degrees to either side, thus 13 of
  // the scan lines that are 10 degrees apart, at 2 m / cos.
  const PointsData::Reading& points = rig.get<PointsData>().reading();
  ASSERT_EQ(points.size(), 13u);
  for (const PointsData::Point& point : points) {
    EXPECT_NEAR(point.range * std::cos(point.bearing), 2.0, 0.002);
    EXPECT_NEAR(std::remainder(point.bearing, 10.0 * kDegree), 0.0, kAngle);
  }
}

TEST(IconicPlugin, RobotsHideLines) {
  FakeWorld world = field();
  world.addRound(0.5, 2.0, 0.0);
  SensorRig rig("iconic_omnivision",
                "see = ['lines']\nlines = { rays = 36, max_range_m = 5 }\nmax_range_m = 8");
  rig.sense(world, {1.0, 0.0, 0.0});
  // asin(0.5 / 1) = 30 degrees to either side are hidden: 7 scan lines, those at its edge are 0.
  const std::size_t seen = rig.get<PointsData>().reading().size();
  EXPECT_GE(seen, 6u);
  EXPECT_LE(seen, 8u);
  for (const PointsData::Point& point : rig.get<PointsData>().reading())
    EXPECT_GE(std::abs(point.bearing), 29.9 * kDegree);
  SensorRig through("iconic_omnivision",
                    "see = ['lines']\nocclusion = false\nmax_range_m = 8\n"
                    "lines = { rays = 36, max_range_m = 5 }");
  through.sense(world, {1.0, 0.0, 0.0});
  EXPECT_EQ(through.get<PointsData>().reading().size(), 13u);
}

TEST(IconicPlugin, SeesGoalsPostsBallAndRobotsWhereTheyAre) {
  const FakeWorld world = field();
  SensorRig rig("iconic_omnivision", "pose = { x_m = 0.1, theta_deg = 90 }\nmax_range_m = 8");
  rig.sense(world, {0.0, 0.0, 0.0});
  const Pose2 camera{0.1, 0.0, 90 * kDegree};
  const auto bearing = [&](double x, double y) {
    return wrapAngle(std::atan2(y - camera.y, x - camera.x) - camera.theta);
  };
  const LandmarksData::Reading& goals = rig.get<LandmarksData>(1).reading();
  ASSERT_EQ(goals.size(), 2u);
  EXPECT_EQ(goals[0].identity, 1u);
  EXPECT_NEAR(goals[0].range, 6.0, kMillimetre);
  EXPECT_NEAR(goals[1].range, 5.8, kMillimetre);
  EXPECT_NEAR(goals[1].bearing, bearing(5.9, 0), kAngle);
  ASSERT_EQ(rig.get<LandmarksData>(2).reading().size(), 1u);
  EXPECT_NEAR(rig.get<LandmarksData>(2).reading()[0].range, std::hypot(4.9, 3.0), kMillimetre);
  const ObjectsData::Reading& ball = rig.get<ObjectsData>(3).reading();
  ASSERT_EQ(ball.size(), 1u);
  EXPECT_EQ(ball[0].colour, 0xffa500u);
  EXPECT_NEAR(ball[0].range, std::hypot(0.9, 2.0), kMillimetre);
  EXPECT_NEAR(ball[0].bearing, bearing(1, 2), kAngle);
  EXPECT_NEAR(ball[0].radius, 0.11, kMillimetre);
  const ObjectsData::Reading& robots = rig.get<ObjectsData>(4).reading();
  ASSERT_EQ(robots.size(), 1u);
  EXPECT_EQ(robots[0].colour, 0x00ffffu);
  EXPECT_NEAR(robots[0].bearing, bearing(0, -2), kAngle);
  EXPECT_TRUE(rig.get<ObjectsData>(5).reading().empty());
  EXPECT_EQ(rig.data[5]->sequence(), 1u);  // looked and saw nothing
}

TEST(IconicPlugin, ARobotHidesTheBallAndIsNotItself) {
  const FakeWorld world = field();
  SensorRig rig("iconic_omnivision", "see = ['ball', 'robots']");
  // The ball at (1, 2) and the robot at (0, -2) are on one line with (-0.5, -4) ...
  rig.sense(world, {-0.5, -3.9, 0.0});
  EXPECT_TRUE(rig.get<ObjectsData>(0).reading().empty());
  EXPECT_EQ(rig.get<ObjectsData>(1).reading().size(), 1u);
  // ... but not with (1, -3).
  rig.sense(world, {1.0, -3.0, 0.0});
  EXPECT_EQ(rig.get<ObjectsData>(0).reading().size(), 1u);
  SensorRig own("iconic_omnivision", "see = ['robots']");
  RobotState state;
  state.number = world.objects()[1].robot;
  state.pose = {0.0, -2.0, 0.0};
  own.sensor->generateData(world, state, nullptr, 1, own.data);
  EXPECT_TRUE(own.get<ObjectsData>().reading().empty());
}

TEST(IconicPlugin, GoalsThatLookAlikeArePoints) {
  const FakeWorld world = field();
  SensorRig rig("iconic_omnivision", "see = ['goals']\ngoals = { identified = false }");
  rig.sense(world, {0.0, 0.0, 0.0});
  const PointsData::Reading& goals = rig.get<PointsData>().reading();
  ASSERT_EQ(goals.size(), 2u);
  EXPECT_NEAR(goals[0].range, 5.9, kMillimetre);
  EXPECT_NEAR(std::abs(goals[0].bearing), std::numbers::pi, kAngle);
}

TEST(IconicPlugin, TheCameraKeepsToItsFieldOfView) {
  const FakeWorld world = field();
  SensorRig rig("iconic_camera", "fov_deg = 60\nmax_range_m = 7\nlines = { rays = 7 }");
  rig.sense(world, {0.0, 0.0, 0.0});
  // 7 scan lines from -30 to 30 degrees all meet x = 3 within 3.5 m.
  ASSERT_EQ(rig.get<PointsData>().reading().size(), 7u);
  EXPECT_NEAR(rig.get<PointsData>().reading().front().bearing, -30 * kDegree, kAngle);
  EXPECT_NEAR(rig.get<PointsData>().reading().back().bearing, 30 * kDegree, kAngle);
  ASSERT_EQ(rig.get<LandmarksData>(1).reading().size(), 1u);  // the goal ahead
  EXPECT_EQ(rig.get<LandmarksData>(1).reading()[0].identity, 2u);
  EXPECT_TRUE(rig.get<LandmarksData>(2).reading().empty());  // the post is at 31 degrees
  EXPECT_TRUE(rig.get<ObjectsData>(3).reading().empty());    // the ball at 63
  EXPECT_TRUE(rig.get<ObjectsData>(4).reading().empty());    // the robot at -90
  rig.sense(world, {0.0, 0.0, 60 * kDegree});
  EXPECT_EQ(rig.get<ObjectsData>(3).reading().size(), 1u);
}

TEST(IconicPlugin, HasNoiseThatGrowsMissesAndImagines) {
  const FakeWorld world = field();
  SensorRig rig("iconic_omnivision",
                "see = ['ball', 'goals']\nnoise_range_sigma_m = 0.01\nmax_range_m = 8\n"
                "noise_range_sigma_per_m = 0.02\nnoise_bearing_sigma_deg = 2\n"
                "missed_share = 0.25\nfalse_share = 0.1");
  Random noise(6);
  Statistics ranges;
  Statistics bearings;
  int ghosts = 0;
  constexpr int kReadings = 8000;
  for (int i = 0; i < kReadings; ++i) {
    rig.sense(world, {1.0, -1.0, 0.0}, &noise);
    for (const ObjectsData::Object& ball : rig.get<ObjectsData>(0).reading()) {
      if (ball.colour == ObjectsData::kNoColour) {
        ++ghosts;
        continue;
      }
      ranges.add(ball.range);
      bearings.add(ball.bearing);
    }
  }
  EXPECT_NEAR(ranges.count() / double{kReadings}, 0.75, 0.02);  // 4 sigma of 8000 draws
  EXPECT_NEAR(ghosts / double{kReadings}, 0.1, 0.0135);
  EXPECT_NEAR(ranges.mean(), 3.0, 0.0037);    // sigma 0.07: 4 * 0.07 / sqrt(6000)
  EXPECT_NEAR(ranges.sigma(), 0.07, 0.0026);  // 4 * 0.07 / sqrt(12000)
  EXPECT_NEAR(bearings.mean(), 90 * kDegree, 0.11 * kDegree);
  EXPECT_NEAR(bearings.sigma(), 2 * kDegree, 0.074 * kDegree);
}

TEST(CompassPlugin, PointsNorthAndLearnsTheHeading) {
  const FakeWorld world(4.0, 4.0);
  SensorRig rig("compass", "pose = { theta_deg = 90 }\nnorth_deg = 30\nsigma_deg = 10");
  rig.sense(world, {0.0, 0.0, 50 * kDegree});
  EXPECT_NEAR(rig.get<BearingData>().reading().value(), (30 - 50 - 90) * kDegree, kAngle);
  const FieldRegion region = world.region(0.5, {0.2});
  SensorData& data = *rig.data[0];
  data.beginLearning(region, 2 * kDegree);
  for (std::size_t cell = 0; cell < region.grid.size(); ++cell) {
    const Pose2 robot{region.grid.centreX(cell), region.grid.centreY(cell), 0.0};
    rig.sense(world, robot);
    data.learnProbability(robot);
  }
  data.endLearning();
  rig.sense(world, {0.3, 0.4, 50 * kDegree});
  EXPECT_NEAR(data.getProbability({-1.0, 1.0, 50 * kDegree}), 1.0, 1e-4);
  EXPECT_NEAR(data.getProbability({-1.0, 1.0, 60 * kDegree}), 0.9 * std::exp(-0.5) + 0.1, 2e-3);
  EXPECT_NEAR(data.getProbability({0.3, 0.4, -130 * kDegree}), 0.1, 1e-4);
}

}  // namespace
}  // namespace ortung

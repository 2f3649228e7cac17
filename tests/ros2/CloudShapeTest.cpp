/// Scans that are made of the clouds of a lidar, beside closed-form geometry.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "CloudMaker.hpp"
#include "CloudShape.hpp"
#include "Seeded.hpp"
#include "ortung/base/Angles.hpp"

namespace ortung::ros2 {
namespace {

using testing::CloudForm;
using testing::cloudOf;
using testing::CloudPoint;

constexpr double kPi = std::numbers::pi;
constexpr double kNone = -1.0;     ///< in the place of NaN, which equals nothing
constexpr double kEndless = 1000;  ///< in the place of infinity

Eigen::Isometry3d poseOf(double x, double y, double z, double roll = 0, double pitch = 0,
                         double yaw = 0) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translate(Eigen::Vector3d(x, y, z));
  pose.rotate(Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()) *
              Eigen::AngleAxisd(pitch, Eigen::Vector3d::UnitY()) *
              Eigen::AngleAxisd(roll, Eigen::Vector3d::UnitX()));
  return pose;
}
Eigen::Matrix3d tiltOf(double roll, double pitch) { return poseOf(0, 0, 0, roll, pitch).linear(); }

/// Points of the level frame of a robot, as its lidar has them.
std::vector<CloudPoint> seen(std::vector<CloudPoint> points, const Eigen::Isometry3d& mount,
                             const Eigen::Matrix3d& tilt = Eigen::Matrix3d::Identity()) {
  for (CloudPoint& p : points) {
    const Eigen::Vector3d at =
        mount.inverse() * (tilt.transpose() * Eigen::Vector3d(p.x, p.y, p.z));
    p = {at.x(), at.y(), at.z(), p.time};
  }
  return points;
}

/// The ranges of a cloud in [m]; none if it was refused.
std::vector<double> ranges(CloudShape& shape, const PointCloud& cloud, const SweepMotion& motion) {
  std::string why;
  std::vector<double> list;
  const auto layout = CloudLayout::of(cloud, why);
  if (!layout) return list;
  for (const float range : shape.fit(*layout, motion, why))
    list.push_back(std::isnan(range)   ? kNone
                   : std::isinf(range) ? kEndless
                                       : static_cast<double>(range));
  EXPECT_EQ(list.empty(), !why.empty());
  return list;
}
std::vector<double> ranges(CloudShape& shape, const PointCloud& cloud,
                           const Eigen::Matrix3d& tilt = Eigen::Matrix3d::Identity(),
                           const PlanarVelocity& motion = {}) {
  return ranges(shape, cloud, SweepMotion{tilt, tilt, motion});
}

/// A room of 8 m x 6 m around the robot at (1, 0.5) of its middle: a wall at a bearing from a
/// place.
double wallAt(double bearing, double x, double y) {
  const double c = std::cos(bearing);
  const double s = std::sin(bearing);
  const double alongX = ((c > 0 ? 3.0 : -5.0) - x) / c;
  const double alongY = ((s > 0 ? 2.5 : -3.5) - y) / s;
  return std::min(alongX > 0 ? alongX : 1e9, alongY > 0 ? alongY : 1e9);
}

/// The middle of each beam, at some heights, on the room's walls as seen from a place.
std::vector<CloudPoint> room(int beams, double x, double y, std::initializer_list<double> heights) {
  std::vector<CloudPoint> points;
  for (int i = 0; i < beams; ++i) {
    const double bearing = -kPi + kTurn / beams * i;
    const double range = wallAt(bearing, x, y);
    for (const double z : heights)
      points.push_back({x + range * std::cos(bearing), y + range * std::sin(bearing), z});
  }
  return points;
}

void expectRoom(const std::vector<double>& found, double x, double y, double within = 1e-4) {
  ASSERT_FALSE(found.empty());
  for (std::size_t i = 0; i < found.size(); ++i) {
    const double bearing =
        -kPi + kTurn / static_cast<double>(found.size()) * static_cast<double>(i);
    EXPECT_NEAR(found[i], wallAt(bearing, x, y), within) << "beam " << i;
  }
}

TEST(CloudShape, TheScannerSitsAtTheLidarAndSeesAllAroundInTheRobotsFrame) {
  const CloudShape shape({.beams = 90, .maxRange = 12.0}, poseOf(0.25, -0.1, 0.8, 0.1, 0.2, 0.3));
  const Scanner scanner = shape.scanner();
  EXPECT_EQ(scanner.mount.x, 0.25);
  EXPECT_EQ(scanner.mount.y, -0.1);
  EXPECT_EQ(scanner.mount.theta, 0.0);
  EXPECT_EQ(scanner.beams, 90);
  EXPECT_DOUBLE_EQ(scanner.firstAngle, -kPi);
  EXPECT_DOUBLE_EQ(scanner.angleStep * 90, kTurn);
  EXPECT_EQ(scanner.maxRange, 12.0);
}

TEST(CloudShape, PointsInTheBandOfHeightsBecomeTheNearestRanges) {
  const auto mount = poseOf(0, 0, 0.5);
  CloudShape shape({.beams = 8, .minHeight = 0.2, .maxHeight = 1.0, .minRange = 0.3, .maxRange = 9},
                   mount);
  // Ahead (beam 4) a table before a wall; to the left (beam 6) the floor and a ceiling; to the
  // right (beam 2) the robot itself before a wall; behind (beam 0) at both ends of the turn.
  const std::vector<CloudPoint> points{{4.0, 0.1, 0.9},  {2.0, 0.0, 0.3},   {4.0, 0.0, 0.5},
                                       {0.0, 2.0, 0.19}, {0.0, 2.0, 1.01},  {0.0, -0.2, 0.5},
                                       {0.0, -3.0, 0.5}, {-2.0, 0.01, 0.5}, {-2.0, -0.01, 0.5}};
  const auto found = ranges(shape, cloudOf(seen(points, mount)));
  ASSERT_EQ(found.size(), 8u);
  EXPECT_NEAR(found[4], 2.0, 1e-6);
  EXPECT_EQ(found[6], kNone);
  EXPECT_NEAR(found[2], 3.0, 1e-6);
  EXPECT_NEAR(found[0], std::hypot(2.0, 0.01), 1e-6);
  for (const std::size_t empty : {1, 3, 5, 7}) EXPECT_EQ(found[empty], kNone) << empty;
}

// The mean of points that scatter about a wall is the wall; the nearest one would be 2 cm too near.
TEST(CloudShape, TheRangeIsTheMeanOfTheNearestSurface) {
  const auto mount = poseOf(0, 0, 0.5);
  CloudShape shape({.beams = 8}, mount);
  const std::vector<CloudPoint> points{
      {2.98, 0, 0.5}, {3.02, 0, 0.5}, {3.01, 0, 0.6}, {2.99, 0, 0.4}, {8.0, 0, 0.5}};
  EXPECT_NEAR(ranges(shape, cloudOf(seen(points, mount)))[4], 3.0, 1e-6);
}

// Of points that are a third of a beam beside its middle, on a slanted wall; at corners and where
// there is a step, they stay.
TEST(CloudShape, RangesAreThoseOfTheMiddleOfTheirBeams) {
  const auto mount = poseOf(0, 0, 0.5);
  CloudShape shape({.beams = 360}, mount);
  std::vector<CloudPoint> points;
  const auto wall = [](double bearing) { return 3.0 / std::cos(bearing - 0.8); };
  for (int i = 180; i <= 240; ++i) {
    const double bearing = -kPi + radians(1.0) * (i + (i % 2 == 0 ? 0.3 : 0.35));
    const double range = wall(bearing) - (i > 220 ? 1.0 : 0.0);
    points.push_back({range * std::cos(bearing), range * std::sin(bearing), 0.5});
  }
  const auto found = ranges(shape, cloudOf(seen(points, mount)));
  const auto off = [&](std::size_t beam) {
    return std::abs(found[beam] - wall(-kPi + radians(1.0) * static_cast<double>(beam)));
  };
  for (std::size_t beam = 181; beam < 220; ++beam) EXPECT_LT(off(beam), 1e-3) << beam;
  EXPECT_GT(off(180), 5e-3) << "it has no neighbour";
  const double there = -kPi + radians(1.0) * 220.3;
  EXPECT_NEAR(found[220], wall(there), 1e-4) << "its neighbour is of something else";
}

TEST(CloudShape, ABeamHasSeenNothingOnlyWhereItsWholeWayWasInTheBand) {
  const CloudBand band{
      .beams = 8, .minHeight = 0.2, .maxHeight = 1.5, .minRange = 0.3, .maxRange = 10};
  const auto mount = poseOf(0, 0, 0.5);
  CloudShape shape(band, mount);
  // At 20 m in the heights 2.4 and 2.6, rays from 0.5 have been at 1.45 and 1.55 at 10 m.
  const std::vector<CloudPoint> points{{20, 0, 2.4}, {0, 20, 2.6}, {0, -20, 0.5}, {0, -5, 0.5}};
  auto found = ranges(shape, cloudOf(seen(points, mount)));
  EXPECT_EQ(found[4], kEndless);
  EXPECT_EQ(found[6], kNone);
  EXPECT_NEAR(found[2], 5.0, 1e-6) << "what is near counts";
  // From above the band no ray is in it all the way.
  const auto high = poseOf(0, 0, 1.6);
  CloudShape above(band, high);
  found = ranges(above, cloudOf(seen({{20, 0, 1.3}, {-4, 0, 1.3}}, high)));
  EXPECT_EQ(found[4], kNone);
  EXPECT_NEAR(found[0], 4.0, 1e-6);
}

TEST(CloudShape, WhatIsNoPlaceIsPassedOver) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float inf = std::numeric_limits<float>::infinity();
  const auto mount = poseOf(0, 0, 0.5);
  CloudShape shape({.beams = 8}, mount);
  const auto n = static_cast<double>(nan);
  const auto i = static_cast<double>(inf);
  std::vector<CloudPoint> points{{n, n, n},  {n, 0, 0}, {1, n, 0},      {1, 1, n},
                                 {i, 0, 0},  {i, i, 0}, {0, 0, i},      {1e30, 1, 0},
                                 {0, -i, 0}, {0, 0, 0}, {-0.0, -0.0, 0}};
  std::string why;
  const PointCloud none = cloudOf(points);
  EXPECT_TRUE(shape.fit(*CloudLayout::of(none, why), {}, why).empty());
  EXPECT_EQ(why, "found no point in the band of heights and ranges");
  points.push_back({2, 0, 0});
  const auto found = ranges(shape, cloudOf(points));
  EXPECT_NEAR(found[4], 2.0, 1e-6);
  EXPECT_EQ(std::count(found.begin(), found.end(), kNone), 7);
}

TEST(CloudShape, SettingsThatNoLidarHasAreRefused) {
  const auto complaint = [](const CloudBand& band) {
    try {
      band.check();
    } catch (const std::invalid_argument& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_EQ(complaint({}), "");
  EXPECT_EQ(complaint({.beams = 7}), "beams is 7.000000, must be in [8.000000, 8192.000000]");
  EXPECT_NE(complaint({.minHeight = 2, .maxHeight = 2}).find("must be below the greatest"),
            std::string::npos);
  EXPECT_NE(complaint({.minRange = 40}).find("must be below the greatest"), std::string::npos);
  EXPECT_NE(complaint({.minRange = 0}).find("the least range"), std::string::npos);
  EXPECT_NE(complaint({.maxHeight = std::nan("")}).find("the greatest height"), std::string::npos);
}

// However a lidar is mounted, and however the robot leans, a room is the same room.
RC_GTEST_PROP(CloudShapeProperty, MountsAndTiltsDoNotChangeTheRoom, ()) {
  const auto any = [](double most) { return most * *rc::gen::inRange(-1000, 1001) / 1000.0; };
  const auto mount = poseOf(any(0.4), any(0.4), 0.8 + any(0.5), any(3), any(1.5), any(3));
  const Eigen::Matrix3d tilt = tiltOf(any(0.3), any(0.3));
  CloudShape shape({.beams = 180, .minHeight = 0.2, .maxHeight = 1.8, .minRange = 0.5}, mount);
  const Pose2 at = shape.scanner().mount;
  auto points = room(180, at.x, at.y, {0.3, 1.1, 1.7});
  const auto walls = points.size();
  for (std::size_t i = 0; i < walls; i += 5) {  // a floor and a ceiling
    points.push_back({points[i].x / 2, points[i].y / 2, 0.1});
    points.push_back({points[i].x / 2, points[i].y / 2, 1.9});
  }
  const auto found = ranges(shape, cloudOf(seen(points, mount, tilt)), tilt);
  RC_ASSERT(found.size() == 180u);
  for (std::size_t i = 0; i < found.size(); ++i)
    RC_ASSERT(std::abs(found[i] - wallAt(-kPi + kTurn / 180 * static_cast<double>(i), at.x, at.y)) <
              1e-4);
}

// The beam of a point is that to which the bearing is rounded, by the standard library's atan2.
RC_GTEST_PROP(CloudShapeProperty, PointsAreInTheBeamThatIsNearest, ()) {
  const int beams = *rc::gen::inRange(8, 8193);
  const double bearing = kPi * *rc::gen::inRange(-1'000'000, 1'000'001) / 1e6;
  const double range = 1.0 + *rc::gen::inRange(0, 1000) / 50.0;
  const double place = (bearing + kPi) / kTurn * beams + 0.5;
  RC_PRE(std::abs(place - std::round(place)) > 0.01);  // where float decides otherwise
  CloudShape shape({.beams = beams}, poseOf(0, 0, 0.5));
  const auto found =
      ranges(shape, cloudOf({{range * std::cos(bearing), range * std::sin(bearing), 0}}));
  const auto beam = static_cast<std::size_t>(place) % static_cast<std::size_t>(beams);
  RC_ASSERT(std::abs(found[beam] - range) < 1e-5 * range);
}

/// A sweep of a tenth of a second, each point seen from where the robot was at its time.
std::vector<CloudPoint> sweep(const PlanarVelocity& motion, double begin,
                              const Eigen::Isometry3d& mount) {
  std::vector<CloudPoint> points = room(360, 0, 0, {0.5});
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double time = begin + 0.1 * static_cast<double>(i) / 360.0;
    // An arc in 10,000 straight steps, a second way to get there.
    Pose2 there;
    for (int step = 0; step < 10'000; ++step)
      there = there * Pose2{motion.forward * time / 1e4, motion.left * time / 1e4,
                            motion.turn * time / 1e4};
    const Pose2 p = inverse(there) * Pose2{points[i].x, points[i].y, 0};
    points[i] = {p.x, p.y, points[i].z, time};
  }
  return seen(points, mount);
}

TEST(CloudShape, TheMotionDuringASweepIsTakenOut) {
  const auto mount = poseOf(0, 0, 0.4);
  const PlanarVelocity motion{1.5, -0.5, 2.0};
  CloudForm form;
  form.fields.push_back({"time", 16, CloudForm::Field::kFloat, 1});
  form.pointStep = 20;
  for (const double begin : {0.0, -0.05, -0.1}) {  // stamps of its beginning, middle and end
    CloudShape shape({.beams = 360}, mount);
    const PointCloud cloud = cloudOf(sweep(motion, begin, mount), form);
    // Points that were moved fall beside the middle of their beam by rounding, not more.
    expectRoom(ranges(shape, cloud, Eigen::Matrix3d::Identity(), motion), 0, 0, 1e-3);
    double worst = 0.0;
    const auto raw = ranges(shape, cloud);
    for (std::size_t i = 0; i < raw.size(); ++i)
      if (raw[i] != kNone)
        worst = std::max(
            worst, std::abs(raw[i] - wallAt(-kPi + kTurn / 360 * static_cast<double>(i), 0, 0)));
    EXPECT_GT(worst, 0.1) << "it would be that far off";
  }
}

// Seen while the robot goes on from one tilt to another, a tenth of a second later.
TEST(CloudShape, ARobotThatSwaysIsLevelledThroughoutTheSweep) {
  const auto mount = poseOf(0.1, -0.2, 1.2, 0.3, 0.2, 0.5);
  CloudShape shape({.beams = 360}, mount);
  const Pose2 at = shape.scanner().mount;
  const auto tilt = [](double share) { return tiltOf(0.05 - 0.04 * share, -0.03 + 0.06 * share); };
  std::vector<CloudPoint> points = room(360, at.x, at.y, {0.3, 1.7});
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double share = static_cast<double>(i) / static_cast<double>(points.size() - 1);
    points[i] = seen({points[i]}, mount, tilt(share))[0];
    points[i].time = 1e8 * share;
  }
  CloudForm form;
  form.fields.push_back({"t", 16, CloudForm::Field::kWord, 1});
  form.pointStep = 20;
  // What is mixed are the numbers of two rotations that are 0.07 rad apart: in the middle they are
  // too small by 1 - cos(0.07 / 2), 6e-4 of a range.
  expectRoom(ranges(shape, cloudOf(points, form), SweepMotion{tilt(0), tilt(1), {}}), at.x, at.y,
             4e-3);
}

TEST(CloudShape, WithoutTimesOrMotionPointsStayWhereTheyAre) {
  const auto mount = poseOf(0, 0, 0.4);
  CloudShape shape({.beams = 360}, mount);
  const PointCloud cloud = cloudOf(seen(room(360, 0, 0, {0.5}), mount));
  expectRoom(ranges(shape, cloud, Eigen::Matrix3d::Identity(), {1, 0, 1}), 0, 0);
}

TEST(CloudShape, ALaterCloudKnowsNothingOfTheOneBefore) {
  const auto mount = poseOf(0, 0, 0.5);
  CloudShape shape({.beams = 360, .maxRange = 4.0}, mount);
  ranges(shape, cloudOf(seen(room(360, 0, 0, {0.3, 0.9}), mount)));
  const auto found = ranges(shape, cloudOf(seen({{2, 0, 0.5}}, mount)));
  EXPECT_EQ(std::count(found.begin(), found.end(), kNone), 359);
}

}  // namespace
}  // namespace ortung::ros2

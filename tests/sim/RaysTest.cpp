// Ranges against closed form: single precision of Embree leaves some micrometres at these
// distances.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "WorldFiles.hpp"

namespace ortung::test {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kExact = 2e-5;  ///< [m]

const char* const kRoom = R"(
[[rectangle]]
center_m = [0, 2.05]
size_m = [6.2, 0.1]
[[rectangle]]
center_m = [0, -2.05]
size_m = [6.2, 0.1]
[[rectangle]]
center_m = [3.05, 0]
size_m = [0.1, 4.2]
[[rectangle]]
center_m = [-3.05, 0]
size_m = [0.1, 4.2]
)";

TEST(Rays, MeasureARectangularRoomInAllDirections) {
  const auto world = worldOf(kRoom);
  std::vector<float> ranges(3600);
  const double x = 0.7;
  const double y = -0.4;
  world->castFan({.x = x,
                  .y = y,
                  .z = 0.3,
                  .firstAngle = -kPi,
                  .angleStep = 2 * kPi / 3600,
                  .elevation = 0,
                  .maxRange = 20},
                 0, ranges);
  for (std::size_t i = 0; i < ranges.size(); ++i) {
    const double angle = -kPi + 2 * kPi * static_cast<double>(i) / 3600;
    const double c = std::cos(angle);
    const double s = std::sin(angle);
    const double toX = c > 0 ? (3 - x) / c : (-3 - x) / c;  // infinite along the wall
    const double toY = s > 0 ? (2 - y) / s : (-2 - y) / s;
    ASSERT_NEAR(static_cast<double>(ranges[i]), std::min(std::abs(toX), std::abs(toY)), kExact)
        << i;
  }
}

TEST(Rays, GiveTheGreatestRangeWhereThereIsNothing) {
  const auto world = worldOf(kRoom);
  EXPECT_DOUBLE_EQ(rangeAt(*world, 0, 0, 0, 0.3, 2.5), 2.5);
  EXPECT_DOUBLE_EQ(rangeAt(*world, 10, 0, 0, 0.3, 8.0), 8.0);
}

TEST(Rays, DoNotDependOnHowManyThereAre) {
  const auto world = worldOf(kRoom);
  std::vector<float> all(50);
  const RayFan fan{.x = 0.1,
                   .y = 0.2,
                   .z = 0.3,
                   .firstAngle = 0.5,
                   .angleStep = 0.1,
                   .elevation = 0,
                   .maxRange = 20};
  world->castFan(fan, 0, all);
  for (std::size_t n = 1; n < all.size(); ++n) {
    std::vector<float> some(n);
    world->castFan(fan, 0, some);
    for (std::size_t i = 0; i < n; ++i) ASSERT_EQ(some[i], all[i]) << n << " rays";
  }
  world->castFan(fan, 0, {});  // none at all
}

TEST(Rays, MeetATurnedRectangle) {
  // A square of 2 m turned by 45 degrees has a corner at sqrt(2) towards x.
  const auto world = worldOf("[[rectangle]]\ncenter_m = [5, 0]\nsize_m = [2, 2]\nangle_deg = 45\n");
  EXPECT_NEAR(rangeAt(*world, 0, 1e-7, 0), 5 - std::sqrt(2.0), kExact);
  EXPECT_NEAR(rangeAt(*world, 0, 0.5, 0), 5 - std::sqrt(2.0) + 0.5, kExact);
  EXPECT_DOUBLE_EQ(rangeAt(*world, 0, 1.5, 0), 50.0);
}

TEST(Rays, MeetACircleExactly) {
  const auto world = worldOf("[[ellipse]]\ncenter_m = [5, 1]\nsize_m = [0.4, 0.4]\n");
  int hits = 0;
  for (int i = -400; i <= 400; ++i) {
    const double angle = std::atan2(1.0, 5.0) + i * 1e-4;
    const double along = 5 * std::cos(angle) + std::sin(angle);
    const double beside = std::cos(angle) - 5 * std::sin(angle);
    const double root = 0.04 - beside * beside;
    if (std::abs(root) < 1e-4) continue;  // rounding decides at the very edge
    const double expected = root > 0 ? along - std::sqrt(root) : 50.0;
    ASSERT_NEAR(rangeAt(*world, 0, 0, angle), expected, 1e-4) << i;
    hits += root > 0 ? 1 : 0;
  }
  EXPECT_GT(hits, 700);
}

TEST(Rays, MeetAnEllipseWithinHalfAMillimetre) {
  const auto world = worldOf("[[ellipse]]\ncenter_m = [5, 0]\nsize_m = [3, 1]\nangle_deg = 30\n");
  for (int i = -60; i <= 60; ++i) {
    // In the ellipse's own frame, stretched to a unit circle: |p + t d| = 1.
    const double angle = i * 1e-3;
    const double c = std::cos(kPi / 6);
    const double s = std::sin(kPi / 6);
    const double px = c * -5 / 1.5;
    const double py = s * 5 / 0.5;
    const double dx = (c * std::cos(angle) + s * std::sin(angle)) / 1.5;
    const double dy = (c * std::sin(angle) - s * std::cos(angle)) / 0.5;
    const double a = dx * dx + dy * dy;
    const double b = px * dx + py * dy;
    const double expected = (-b - std::sqrt(b * b - a * (px * px + py * py - 1))) / a;
    ASSERT_NEAR(rangeAt(*world, 0, 0, angle), expected, 1e-3) << i;  // 0.5 mm across, met aslant
  }
}

TEST(Rays, MeetATriangleWhicheverWayItsCornersRun) {
  for (const char* corners : {"[4, -1, 6, 0, 4, 1]", "[4, 1, 6, 0, 4, -1]"}) {
    const auto world = worldOf(std::string("[[triangle]]\ncorners_m = ") + corners + "\n");
    EXPECT_NEAR(rangeAt(*world, 0, 0.5, 0), 4, kExact);
    EXPECT_NEAR(rangeAt(*world, 10, 0.5, kPi), 10 - 5, kExact);  // y = 0.5 leaves it at x = 5
  }
}

TEST(Rays, PassAboveAndBelowWhatEndsInZ) {
  const auto world = worldOf(
      "[[rectangle]]\ncenter_m = [3, 0]\nsize_m = [0.2, 2]\nz_m = [0, 0.3]\n"
      "[[ellipse]]\ncenter_m = [5, 0]\nsize_m = [0.2, 0.2]\nz_m = [0.5, 1.0]\n");
  EXPECT_NEAR(rangeAt(*world, 0, 0, 0, 0.2), 2.9, kExact);
  EXPECT_DOUBLE_EQ(rangeAt(*world, 0, 0, 0, 0.4), 50.0);
  EXPECT_NEAR(rangeAt(*world, 0, 0, 0, 0.6), 4.9, kExact);
  EXPECT_DOUBLE_EQ(rangeAt(*world, 0, 0, 0, 1.1), 50.0);
}

TEST(Rays, ThatFallMeetTheTopsOfBodies) {
  const auto world = worldOf(
      "[[rectangle]]\ncenter_m = [3, 0]\nsize_m = [2, 2]\nz_m = [0, 0.5]\n"
      "[[ellipse]]\ncenter_m = [0, 3]\nsize_m = [2, 2]\nz_m = [0, 0.5]\n");
  // From 1.5 m height down by 1 m over 3 m.
  for (const double angle : {0.0, kPi / 2}) {
    float range = 0;
    world->castFan({.x = 0,
                    .y = 0,
                    .z = 1.5,
                    .firstAngle = angle,
                    .angleStep = 0,
                    .elevation = -std::atan2(1.0, 3.0),
                    .maxRange = 20},
                   0, {&range, 1});
    EXPECT_NEAR(static_cast<double>(range), std::sqrt(10.0), 1e-4) << angle;
  }
}

TEST(Rays, ThatRiseOrFallMeetARoundBodyWhereTheyCrossItsSurface) {
  // A cylinder of radius 1 m around (4, 1), from 0.5 to 1 m; from above and from below, aslant.
  const auto world = worldOf("[[ellipse]]\ncenter_m = [4, 1]\nsize_m = [2, 2]\nz_m = [0.5, 1]\n");
  std::array<int, 3> met{};  // side, top or bottom, nothing
  for (const double height : {0.0, 1.8})
    for (int i = -30; i <= 30; ++i)
      for (int k = 3; k <= 40; ++k) {
        const double angle = std::atan2(1.0, 4.0) + 0.01 * i;
        const double elevation = (height > 1.0 ? -0.01 : 0.01) * k;
        const double ux = std::cos(elevation) * std::cos(angle);
        const double uy = std::cos(elevation) * std::sin(angle);
        const double uz = std::sin(elevation);
        const auto inside = [&](double t) { return std::hypot(t * ux - 4, t * uy - 1) - 1; };
        const double flat = ((height > 1.0 ? 1.0 : 0.5) - height) / uz;  // to the level it comes to
        const double along = 4 * std::cos(angle) + std::sin(angle);
        const double beside = std::cos(angle) - 4 * std::sin(angle);
        const double root = 1.0 - beside * beside;
        const double round =
            root > 0 ? (along - std::sqrt(root)) / std::cos(elevation) : 1e9;  // to its mantle
        const double z = height + round * uz;
        if (std::abs(root) < 1e-3 || std::abs(inside(flat)) < 1e-3 || std::abs(z - 0.5) < 1e-3 ||
            std::abs(z - 1.0) < 1e-3)
          continue;  // rounding decides at the very edge
        const bool isSide = root > 0 && z > 0.5 && z < 1.0;
        const bool isFlat = inside(flat) < 0;
        const double expected = std::min(isSide ? round : 50.0, isFlat ? flat : 50.0);
        float range = 0;
        world->castFan({.x = 0,
                        .y = 0,
                        .z = height,
                        .firstAngle = angle,
                        .angleStep = 0,
                        .elevation = elevation,
                        .maxRange = 50},
                       0, {&range, 1});
        ASSERT_NEAR(static_cast<double>(range), expected, 1e-3) << height << " " << i << " " << k;
        ++met[isSide ? 0 : isFlat ? 1 : 2];
      }
  for (const int count : met) EXPECT_GT(count, 200);
}

TEST(Rays, IgnoreLines) {
  const auto world = worldOf(
      "[world]\nx_m = [-9, 9]\ny_m = [-9, 9]\n"
      "[[rectangle]]\nkind = \"line\"\ncenter_m = [3, 0]\nsize_m = [0.1, 9]\n"
      "[[ellipse]]\nkind = \"line\"\ncenter_m = [0, 0]\nsize_m = [2, 2]\nstroke_m = 0.1\n");
  EXPECT_DOUBLE_EQ(rangeAt(*world, 0, 0, 0, 0.0, 8.0), 8.0);
  EXPECT_TRUE(world->isFree(3, 0, {0.2}));
}

TEST(Rays, StayExactFarFromTheOrigin) {
  const auto world = worldOf(
      "[[rectangle]]\ncenter_m = [9000, -8000]\nsize_m = [1, 1]\n"
      "[[ellipse]]\ncenter_m = [9000, -8010]\nsize_m = [1, 1]\n");
  EXPECT_NEAR(rangeAt(*world, 8990, -8000.0, 0), 9.5, 1e-4);
  EXPECT_NEAR(rangeAt(*world, 8990, -8010.0, 0), 9.5, 1e-4);
}

TEST(Rays, OfAFanThatIsNotFiniteAreAllTheGreatestRange) {
  const auto world = worldOf(kRoom);
  EXPECT_EQ(rangeAt(*world, std::nan(""), 0, 0, 0.3, 8.0), 8.0);
  EXPECT_EQ(rangeAt(*world, 0, 0, HUGE_VAL, 0.3, 8.0), 8.0);
  EXPECT_EQ(rangeAt(*world, 0, 0, 0, 0.3, std::nan("")), 0.0);
}

TEST(Robots, AreSeenByOthersAndNotByThemselves) {
  const auto world = worldOf(kRoom);
  const RobotNumber own = addRobot(*world, 0.2, 0.5);
  EXPECT_NEAR(rangeAt(*world, 0, 0, 0), 3, kExact);  // nowhere yet
  world->moveBody(own, {0, 0, 0});
  EXPECT_NEAR(rangeAt(*world, 0, 0, 0, 0.3, 50, own), 3, kExact);
  const RobotNumber other = addRobot(*world, 0.25, 0.5);
  world->moveBody(other, {1.5, 0, 1});
  EXPECT_NEAR(rangeAt(*world, 0, 0, 0, 0.3, 50, own), 1.25, kExact);
  EXPECT_NEAR(rangeAt(*world, 0, 0, 0, 0.6, 50, own), 3, kExact);  // over it
  EXPECT_NEAR(rangeAt(*world, 1.5, 0, kPi, 0.3, 50, other), 1.5 - 0.2, kExact);
  world->moveBody(other, {1.5, 1, 1});
  EXPECT_NEAR(rangeAt(*world, 0, 0, 0, 0.3, 50, own), 3, kExact);
}

TEST(Robots, ThatLeaveAreNoObstacles) {
  const auto world = worldOf(kRoom);
  const RobotNumber robot = addRobot(*world, 0.25, 0.5);
  world->moveBody(robot, {1.5, 0, 0});
  EXPECT_NEAR(rangeAt(*world, 0, 0, 0), 1.25, kExact);
  world->removeBody(robot);
  EXPECT_NEAR(rangeAt(*world, 0, 0, 0), 3, kExact);
  EXPECT_THROW(world->moveBody(robot, {}), std::invalid_argument);
  EXPECT_NE(addRobot(*world, 0.25, 0.5), robot);
}

TEST(Robots, OfBadSizeOrPlaceAreRefused) {
  const auto world = worldOf(kRoom);
  EXPECT_THROW(addRobot(*world, 0, 0.5), std::invalid_argument);
  EXPECT_THROW(addRobot(*world, 0.2, std::nan("")), std::invalid_argument);
  const RobotNumber robot = addRobot(*world, 0.25, 0.5);
  EXPECT_THROW(world->moveBody(robot, {std::nan(""), 0, 0}), std::invalid_argument);
  EXPECT_THROW(world->moveBody(robot + 1, {}), std::invalid_argument);
}

TEST(Robots, DoNotChangeWhatIsLearned) {
  const auto world = worldOf(kRoom);
  const std::string before = world->fingerprint();
  world->moveBody(addRobot(*world, 0.25, 0.5), {1, 1, 0});
  EXPECT_EQ(world->fingerprint(), before);
  EXPECT_TRUE(world->isFree(1, 1, {0.3}));
}

TEST(Visibility, EndsAtWallsAndOtherRobots) {
  const auto world = worldOf(kRoom);
  EXPECT_TRUE(world->isVisible(0, 0, 0.3, 2, 1, 0.5, 0, 0));
  EXPECT_FALSE(world->isVisible(0, 0, 0.3, 5, 0, 0.5, 0, 0));
  EXPECT_TRUE(world->isVisible(0, 0, 1.2, 5, 0, 1.2, 0, 0));  // over the wall
  const RobotNumber robot = addRobot(*world, 0.2, 0.5);
  world->moveBody(robot, {1, 0.5, 0});
  EXPECT_FALSE(world->isVisible(0, 0, 0.3, 2, 1, 0.3, 0, 0));
  EXPECT_TRUE(world->isVisible(0, 0, 0.3, 2, 1, 0.3, robot, 0));
}

TEST(Visibility, OfAPostIsNotHiddenByThePostItself) {
  const auto world = worldOf(
      "[[ellipse]]\nkind = \"post\"\nidentity = 1\ncenter_m = [5, 0]\nsize_m = [0.2, 0.2]\n");
  const Landmark& post = world->landmarks()[0];
  EXPECT_FALSE(world->isVisible(0, 0, 0.3, post.x, post.y, post.z, 0, 0));
  EXPECT_TRUE(world->isVisible(0, 0, 0.3, post.x, post.y, post.z, 0, 0.2));
  EXPECT_TRUE(
      world->isVisible(5, 0, 0.5, post.x, post.y, post.z, 0, 0.2));  // nearer than the slack
  EXPECT_FALSE(world->isVisible(std::nan(""), 0, 0.5, post.x, post.y, post.z, 0, 0.2));
}

}  // namespace
}  // namespace ortung::test

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "WorldFiles.hpp"
#include "ortung/base/Random.hpp"

namespace ortung::test {
namespace {

const char* const kMixed = R"(
[world]
x_m = [-3, 3]
y_m = [-2, 2]
[[rectangle]]
center_m = [1, 0.5]
size_m = [1.2, 0.4]
angle_deg = 25
[[ellipse]]
center_m = [-1, -0.5]
size_m = [1.4, 0.6]
angle_deg = -40
[[ellipse]]
center_m = [-2, 1]
size_m = [0.5, 0.5]
[[triangle]]
corners_m = [1, -1.5, 2.2, -1.2, 1.6, -0.4]
[[rectangle]]
center_m = [0, 1.5]
size_m = [1, 1]
z_m = [2.5, 3]
)";

TEST(Region, ASquareFieldWithoutObstaclesLosesARobotsRadiusAtItsEdges) {
  const auto world = worldOf(
      "[world]\nx_m = [0, 2]\ny_m = [0, 1]\n"
      "[[rectangle]]\ncenter_m = [1, -5]\nsize_m = [1, 1]\n");
  const FieldRegion region = world->region(0.1, {0.25});
  EXPECT_EQ(region.grid, (FieldGrid{0, 0, 0.1, 20, 10}));
  EXPECT_EQ(std::accumulate(region.open.begin(), region.open.end(), 0), 200);
  // Centres at 0.05, 0.15, 0.25, ...: two are lost at each side.
  EXPECT_EQ(std::accumulate(region.standable.begin(), region.standable.end(), 0), 16 * 6);
  EXPECT_NO_THROW(region.check());
}

TEST(Region, AgreesWithIsFreeInEveryCell) {
  const auto world = worldOf(kMixed);
  const FieldRegion region = world->region(0.05, {0.3});
  ASSERT_EQ(region.open.size(), region.grid.size());
  ASSERT_EQ(region.standable.size(), region.grid.size());
  for (std::size_t i = 0; i < region.grid.size(); ++i) {
    const double x = region.grid.centreX(i);
    const double y = region.grid.centreY(i);
    ASSERT_EQ(region.open[i] != 0, world->isFree(x, y, {0})) << x << " " << y;
    ASSERT_EQ(region.standable[i] != 0, world->isFree(x, y, {0.3})) << x << " " << y;
  }
}

TEST(Region, KeepsRobotsExactlyTheirRadiusAwayFromAnEllipse) {
  const auto world = worldOf(
      "[world]\nx_m = [-9, 9]\ny_m = [-9, 9]\n"
      "[[ellipse]]\ncenter_m = [0, 0]\nsize_m = [4, 1]\n");
  Random random(3);
  for (int i = 0; i < 2000; ++i) {
    // A point at a known distance: out along the normal at a point of the ellipse.
    const double phi = random.uniform(0, 6.283);
    const double distance = random.uniform(0.05, 3);
    const double nx = std::cos(phi) / 2;
    const double ny = std::sin(phi) / 0.5;
    const double x = 2 * std::cos(phi) + distance * nx / std::hypot(nx, ny);
    const double y = 0.5 * std::sin(phi) + distance * ny / std::hypot(nx, ny);
    ASSERT_TRUE(world->isFree(x, y, {distance - 1e-6})) << phi << " " << distance;
    ASSERT_FALSE(world->isFree(x, y, {distance + 1e-6})) << phi << " " << distance;
  }
}

TEST(Region, KeepsRobotsExactlyTheirRadiusAwayFromATriangle) {
  const auto world = worldOf(
      "[world]\nx_m = [-9, 9]\ny_m = [-9, 9]\n"
      "[[triangle]]\ncorners_m = [0, 0, 4, 0, 0, 3]\n");
  EXPECT_TRUE(world->isFree(2, -1, {0.999}));
  EXPECT_FALSE(world->isFree(2, -1, {1.001}));
  EXPECT_TRUE(world->isFree(-3, -4, {4.999}));  // 3-4-5 to the corner
  EXPECT_FALSE(world->isFree(-3, -4, {5.001}));
  EXPECT_TRUE(world->isFree(2 + 0.6 * 2, 1.5 + 0.8 * 2, {1.999}));  // out of the long side's middle
  EXPECT_FALSE(world->isFree(2 + 0.6 * 2, 1.5 + 0.8 * 2, {2.001}));
  EXPECT_FALSE(world->isFree(1, 1, {0}));
}

TEST(Region, DoesNotCountWhatIsAboveRobots) {
  const auto world = worldOf(kMixed);
  EXPECT_TRUE(world->isFree(0, 1.5, {0.2}));
}

TEST(Region, RefusesBadSizes) {
  const auto world = worldOf(kMixed);
  for (const double cell : {-1.0, -0.1, 0.0, 0.0009, 1000.1}) {
    try {
      world->region(cell, {0.2});
      ADD_FAILURE() << "cells of " << cell << " m were taken";
    } catch (const std::invalid_argument& error) {
      EXPECT_NE(std::string(error.what()).find("m, expected 0.001 to 1000"), std::string::npos)
          << error.what();
    }
  }
  EXPECT_THROW(world->region(std::nan(""), {0.2}), std::invalid_argument);
  EXPECT_THROW(world->region(0.1, {-1}), std::invalid_argument);
  EXPECT_THROW(world->region(0.1, {std::nan("")}), std::invalid_argument);
  EXPECT_THROW(world->region(0.1, {0.2, -1}), std::invalid_argument);
  EXPECT_THROW(world->region(0.1, {0.2, std::nan("")}), std::invalid_argument);
  EXPECT_FALSE(world->isFree(0, 0, {0.2, std::nan("")}));
  EXPECT_FALSE(world->isFree(std::nan(""), 0, {0}));
  const auto huge = worldOf(
      "[[landmark]]\nkind = \"a\"\nidentity = 1\nposition_m = [-10000, -10000]\n"
      "[[landmark]]\nkind = \"a\"\nidentity = 2\nposition_m = [10000, 10000]\n");
  EXPECT_THROW(huge->region(0.1, {0.2}), std::invalid_argument);
}

TEST(Region, OfAHallIsAsLargeAsItMustBe) {
  std::string toml = "[world]\nx_m = [-20, 20]\ny_m = [-20, 20]\n";
  for (int i = 0; i < 200; ++i)
    toml += "[[ellipse]]\ncenter_m = [" + std::to_string(i % 20 * 2 - 19) + ", " +
            std::to_string(i / 20 * 4 - 19) + "]\nsize_m = [0.5, 0.3]\n";
  const auto world = worldOf(toml);
  const FieldRegion region = world->region(0.05, {0.3});
  ASSERT_EQ(region.grid.size(), 640000u);
  const auto count = [](const std::vector<std::uint8_t>& cells) {
    return static_cast<double>(std::count(cells.begin(), cells.end(), 1));
  };
  // Areas of the ellipses, and of those with a border of 0.3 m around (Steiner), in cells.
  const double perimeter = 2.0 * std::numbers::pi * std::hypot(0.25, 0.15) / std::sqrt(2.0) * 0.98;
  const double solid = std::numbers::pi * 0.25 * 0.15;
  const double tight = solid + perimeter * 0.3 + std::numbers::pi * 0.3 * 0.3;
  EXPECT_NEAR(640000.0 - count(region.open), 200 * solid / 0.0025, 0.1 * 200 * solid / 0.0025);
  const double inside = std::pow((40.0 - 0.6) / 0.05, 2.0);
  EXPECT_NEAR(inside - count(region.standable), 200 * tight / 0.0025, 0.1 * 200 * tight / 0.0025);
}

}  // namespace
}  // namespace ortung::test

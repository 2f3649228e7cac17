// What a robot knows of a field beforehand, against a field whose measures are plain.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "WorldFiles.hpp"
#include "ortung/sim_api/World.hpp"

namespace ortung::test {
namespace {

std::string body(const std::string& shape, const std::string& kind, double x, double sizeX,
                 double sizeY, const std::string& more = "") {
  return "[[" + shape + "]]\nkind = \"" + kind + "\"\ncenter_m = [" + std::to_string(x) +
         ", 0]\nsize_m = [" + std::to_string(sizeX) + ", " + std::to_string(sizeY) + "]\n" + more;
}

/// How far a point is on the left of the way along a wall [m].
double leftOf(const FieldWall& wall, double x, double y) {
  return ((wall.x1 - wall.x0) * (y - wall.y0) - (wall.y1 - wall.y0) * (x - wall.x0)) /
         lengthOf(wall);
}

TEST(FieldModel, HasTheFourSidesOfWallsAndGoalsTheLongestFirst) {
  const FieldModel field = fieldModelOf(
      *worldOf(body("rectangle", "goal", -4.0, 0.5, 2.0, "name = \"left\"\nz_m = [0, 1]\n") +
               body("rectangle", "wall", 3.0, 6.0, 0.2, "angle_deg = 30\nz_m = [0.1, 0.4]\n") +
               body("rectangle", "obstacle", 8.0, 1.0, 1.0)));
  ASSERT_EQ(field.walls.size(), 8u);
  const double lengths[] = {6.0, 6.0, 2.0, 2.0, 0.5, 0.5, 0.2, 0.2};
  for (std::size_t i = 0; i < 8; ++i) {
    const FieldWall& wall = field.walls[i];
    const bool ofGoal = i >= 2 && i < 6;
    EXPECT_NEAR(lengthOf(wall), lengths[i], 1e-9) << i;
    EXPECT_EQ(wall.ofGoal, ofGoal) << i;
    EXPECT_EQ(wall.zLow, ofGoal ? 0.0 : 0.1) << i;
    EXPECT_EQ(wall.zHigh, ofGoal ? 1.0 : 0.4) << i;
    // The solid is on its right, as far from it as its middle is from that side.
    const double middle = ofGoal ? (i < 4 ? 0.25 : 1.0) : (i < 2 ? 0.1 : 3.0);
    EXPECT_NEAR(leftOf(wall, ofGoal ? -4.0 : 3.0, 0.0), -middle, 1e-9) << i;
  }
  // Long sides of the wall run along its own x axis.
  const double along =
      std::atan2(field.walls[0].y1 - field.walls[0].y0, field.walls[0].x1 - field.walls[0].x0);
  EXPECT_NEAR(std::remainder(along - std::numbers::pi / 6.0, std::numbers::pi), 0.0, 1e-9);
  ASSERT_EQ(field.goals.size(), 1u);
  EXPECT_EQ(field.goals[0].name, "left");
  EXPECT_EQ(field.goals[0].pose.x, -4.0);
  EXPECT_EQ(field.goals[0].halfY, 1.0);
  EXPECT_EQ(field.goals[0].zHigh, 1.0);
}

TEST(FieldModel, WhatIsRoundHasNoStraightSides) {
  const FieldModel field =
      fieldModelOf(*worldOf(body("ellipse", "wall", 0.0, 2.0, 2.0) +
                            body("ellipse", "goal", 5.0, 1.0, 2.0, "name = \"ring\"\n")));
  EXPECT_TRUE(field.walls.empty());
  ASSERT_EQ(field.goals.size(), 1u);
  EXPECT_EQ(field.goals[0].name, "ring");
}

TEST(FieldModel, KnowsNothingThatMoves) {
  const FieldModel field = fieldModelOf(
      *worldOf(body("rectangle", "wall", 0.0, 2.0, 0.2) +
               body("rectangle", "wall", 5.0, 2.0, 0.2, "movable = true\nmass_kg = 3\n")));
  EXPECT_EQ(field.walls.size(), 4u);
}

}  // namespace
}  // namespace ortung::test

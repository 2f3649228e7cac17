#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "WorldFiles.hpp"

namespace ortung::test {
namespace {

TEST(Seen, LinesAreMiddleLinesWithAWidth) {
  const auto world = worldOf(R"(
[world]
x_m = [-5, 5]
y_m = [-5, 5]
[[rectangle]]
kind = "line"
colour = "white"
center_m = [1, 2]
size_m = [0.1, 4]
[[ellipse]]
kind = "line"
center_m = [0, 0]
size_m = [4, 3]
stroke_m = 0.2
arc_deg = [0, 90]
[[ellipse]]
kind = "line"
center_m = [3, 0]
size_m = [0.15, 0.15]
)");
  ASSERT_EQ(world->lines().size(), 3u);
  const FieldLine& touch = world->lines()[0];
  EXPECT_EQ(touch.shape, FieldLine::Shape::kStraight);
  EXPECT_NEAR(touch.x0, 1.0, 1e-12);
  EXPECT_NEAR(std::min(touch.y0, touch.y1), 0.0, 1e-12);
  EXPECT_NEAR(std::max(touch.y0, touch.y1), 4.0, 1e-12);
  EXPECT_NEAR(touch.width, 0.1, 1e-12);
  EXPECT_EQ(touch.colour, "white");
  const FieldLine& arc = world->lines()[1];
  EXPECT_EQ(arc.shape, FieldLine::Shape::kArc);
  EXPECT_NEAR(arc.radiusX, 1.9, 1e-12);  // the stroke lies within the size
  EXPECT_NEAR(arc.radiusY, 1.4, 1e-12);
  EXPECT_NEAR(arc.to - arc.from, std::numbers::pi / 2.0, 1e-12);
  const FieldLine& spot = world->lines()[2];
  EXPECT_NEAR(spot.width, 0.075, 1e-12);
  EXPECT_NEAR(spot.radiusX, 0.0375, 1e-12);
  EXPECT_NEAR(spot.radiusY, 0.0375, 1e-12);
  EXPECT_NEAR(spot.to - spot.from, 2.0 * std::numbers::pi, 1e-12);
}

constexpr const char* kRoom = R"(
[world]
x_m = [-5, 5]
y_m = [-5, 5]
[[rectangle]]
kind = "wall"
name = "long wall"
colour = "black"
center_m = [0, 5.1]
size_m = [10, 0.2]
)";
constexpr const char* kBall = R"(
[[ellipse]]
kind = "ball"
colour = "orange"
center_m = [1, 1]
size_m = [0.22, 0.22]
z_m = [0, 0.22]
)";

TEST(Seen, ObjectsHaveKindColourPlaceAndExtent) {
  const auto world = worldOf(kRoom);
  ASSERT_EQ(world->objects().size(), 1u);
  const WorldObject& wall = world->objects()[0];
  EXPECT_EQ(wall.kind, "wall");
  EXPECT_EQ(wall.name, "long wall");
  EXPECT_EQ(wall.colour, "black");
  EXPECT_EQ(wall.pose.y, 5.1);
  EXPECT_NEAR(wall.radius, std::hypot(5.0, 0.1), 1e-12);
  EXPECT_FALSE(wall.isMovable);
  EXPECT_EQ(wall.robot, 0u);
}

TEST(Seen, WhatMovesIsNeitherInTablesNorInTheFingerprint) {
  const auto empty = worldOf(kRoom);
  const auto world = worldOf(std::string(kRoom) + kBall);
  EXPECT_EQ(world->fingerprint(), empty->fingerprint());
  EXPECT_NEAR(rangeAt(*world, 0.0, 1.0, 0.0, 0.1), 50.0, 1e-6);
  EXPECT_TRUE(world->isFree(1.0, 1.0, {0.1}));
  EXPECT_EQ(world->objects().size(), 1u);
}

TEST(Seen, ABodyReachesFromItsLowestPieceToItsHighest) {
  const auto world = worldOf(kRoom);
  Primitive tray;
  tray.halfX = tray.halfY = 0.3;
  tray.zLow = 0.4;
  tray.zHigh = 0.5;
  Primitive mast = tray;
  mast.halfX = mast.halfY = 0.05;
  mast.zLow = 0.5;
  mast.zHigh = 1.2;
  RobotNumber drone = 0;
  for (const auto& pieces : {std::vector{tray, mast}, {mast, tray}}) {  // in whatever order
    drone = world->addBody({.kind = "robot", .name = {}, .colour = {}, .pieces = pieces},
                           {1.0, 0.0, 0.0});
    EXPECT_EQ(world->objects().back().zLow, 0.4);
    EXPECT_EQ(world->objects().back().zHigh, 1.2);
  }
  world->reshapeBody(drone, {&mast, 1});  // nothing is left of what it was
  EXPECT_EQ(world->objects().back().zLow, 0.5);
  EXPECT_EQ(world->objects().back().zHigh, 1.2);
  world->reshapeBody(drone, {&tray, 1});
  EXPECT_EQ(world->objects().back().zLow, 0.4);
  EXPECT_EQ(world->objects().back().zHigh, 0.5);
}

TEST(Seen, MechanicsAreRefusedWhereTheyDoNotFit) {
  const auto refusal = [](const std::string& more) { return refusalOf(kRoom + more); };
  EXPECT_NE(refusal("mass_kg = 3").find("mass_kg"), std::string::npos);
  EXPECT_NE(refusal("movable = true").find("mass_kg"), std::string::npos);
  EXPECT_NE(refusal("movable = true\nmass_kg = 0").find("mass_kg"), std::string::npos);
  EXPECT_NE(refusal("movable = true\nmass_kg = 1e30").find("mass_kg"), std::string::npos);
  EXPECT_NE(refusal("movable = true\nmass_kg = 3\nidentity = 1").find("identity"),
            std::string::npos);
  EXPECT_NE(refusal("restitution = 1.5").find("restitution"), std::string::npos);
  EXPECT_NE(refusal("[physics]\ncycle_ms = 0").find("cycle_ms"), std::string::npos);
  EXPECT_NE(refusal("[physics]\nfrictoin = 1").find("frictoin"), std::string::npos);
  EXPECT_EQ(refusal("[physics]\ncycle_ms = 5\nfriction = 0.5\nrestitution = 0.4\n"
                    "floor_friction = 0.5\nrolling_resistance = 0.02"),
            "");
}

}  // namespace
}  // namespace ortung::test

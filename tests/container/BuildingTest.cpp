// Floors side by side in one field, and lifts between them.
#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <stdexcept>

#include "ortung/tables/Building.hpp"
#include "ortung/tables/FieldRegion.hpp"

namespace ortung {
namespace {

Building threeFloors() {
  Building building;
  building.floors = {{"g", 0.0, -5.0, 15.0}, {"one", 30.0, 15.0, 45.0}, {"two", 60.0, 45.0, 75.0}};
  building.lifts = {{"A", 1.0, {{0, {3, 1, 0}}, {2, {63, 1, 0}}}}};
  return building;
}

TEST(Building, HasAFloorForEachPlace) {
  const Building building = threeFloors();
  EXPECT_NO_THROW(building.check());
  EXPECT_EQ(building.floorAt(-1e6), 0u);
  EXPECT_EQ(building.floorAt(14.999), 0u);
  EXPECT_EQ(building.floorAt(15.0), 1u);
  EXPECT_EQ(building.floorAt(44.999), 1u);
  EXPECT_EQ(building.floorAt(45.0), 2u);
  EXPECT_EQ(building.floorAt(1e6), 2u);
  EXPECT_EQ(building.find("one"), 1u);
  EXPECT_EQ(building.find("three"), std::nullopt);
}

TEST(Building, APoseOnAFloorIsShiftedAlongX) {
  const Floor floor = threeFloors().floors[1];
  const Pose2 inField = floor.toField({2.0, -1.0, 0.5});
  EXPECT_EQ(inField.x, 32.0);
  EXPECT_EQ(inField.y, -1.0);
  EXPECT_EQ(inField.theta, 0.5);
  EXPECT_EQ(floor.fromField(inField).x, 2.0);
}

/// Returns why a building that was changed is refused; "": it is not.
std::string whyRefused(const std::function<void(Building&)>& change) {
  Building building = threeFloors();
  change(building);
  try {
    building.check();
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

TEST(Building, WhatAFileMaySayWrongIsRefusedByName) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  const auto says = [](const std::string& text, const char* part) {
    return text.find(part) != std::string::npos;
  };
  EXPECT_EQ(whyRefused([](Building&) {}), "");
  EXPECT_TRUE(says(whyRefused([](Building& b) { b.floors[1].name = "g"; }), "'g'"));
  EXPECT_TRUE(says(whyRefused([](Building& b) { b.floors[2].name = ""; }), "floor 2"));
  EXPECT_TRUE(says(whyRefused([](Building& b) { b.floors[1].xLow = 16.0; }), "'one'"));
  EXPECT_TRUE(says(whyRefused([](Building& b) { b.floors[2].xHigh = 45.0; }), "'two'"));
  EXPECT_TRUE(says(whyRefused([&](Building& b) { b.floors[0].xLow = kNan; }), "'g'"));
  EXPECT_TRUE(says(whyRefused([&](Building& b) { b.floors[0].shift = kNan; }), "'g'"));
  EXPECT_TRUE(says(whyRefused([](Building& b) { b.lifts.push_back(b.lifts[0]); }), "'A'"));
  EXPECT_TRUE(says(whyRefused([](Building& b) { b.lifts[0].radius = 0.0; }), "radius"));
  EXPECT_TRUE(says(whyRefused([](Building& b) { b.lifts[0].stops.resize(1); }), "1 floors"));
  EXPECT_TRUE(says(whyRefused([](Building& b) { b.lifts[0].stops[1].floor = 3; }), "floor 3"));
  EXPECT_TRUE(
      says(whyRefused([](Building& b) { b.lifts[0].stops[1].floor = 0; }), "twice on floor 'g'"));
  EXPECT_TRUE(
      says(whyRefused([](Building& b) { b.lifts[0].stops[1].pose.x = 20.0; }), "floor 'two'"));
  EXPECT_TRUE(
      says(whyRefused([&](Building& b) { b.lifts[0].stops[0].pose.y = kNan; }), "floor 'g'"));
}

TEST(Building, ARegionIsCheckedWithItsFloors) {
  FieldRegion region;
  region.grid = {0.0, 0.0, 0.1, 2, 1};
  region.open = region.standable = {1, 1};
  region.building = threeFloors();
  EXPECT_NO_THROW(region.check());
  region.building.floors[1].name = "g";
  EXPECT_THROW(region.check(), std::invalid_argument);
}

}  // namespace
}  // namespace ortung

#include <algorithm>
#include <cmath>
#include <functional>

#include "RoomRun.hpp"
#include "ortung/run/FieldMaps.hpp"

namespace ortung::test {
namespace {

/// The robot at the run's start, with its scanner.
class FieldMaps : public RoomRun {
 protected:
  FieldMaps() { robot->container.set(moments[0]); }
  Pose2 centre(std::size_t cell, double heading) const {
    return {region.grid.centreX(cell), region.grid.centreY(cell), heading};
  }

  std::unique_ptr<Robot> robot = openRobot(robotFile, tables);
  FieldRegion& region = robot->tables.region;
  const SensorData* scanner = robot->container.find({.type = "LRF"});
  const std::vector<const SensorData*> features{scanner};
};

TEST_F(FieldMaps, ProbabilityIsTheBestOfAllHeadings) {
  region.open[7] = 0;
  const std::vector<double> headings = {0.0, kPi / 2, kPi};
  const std::vector<double> map = probabilityMap(region, weighersOf(features), headings);
  ASSERT_EQ(map.size(), region.grid.size());
  for (std::size_t cell = 0; cell < map.size(); ++cell) {
    double best = std::nan("");
    for (const double heading : headings)
      best = std::fmax(best, scanner->getProbability(centre(cell, heading)));
    if (cell == 7)
      EXPECT_TRUE(std::isnan(map[cell]));
    else
      EXPECT_NEAR(map[cell], best, 1e-6);
  }
}

TEST_F(FieldMaps, ProbabilityIsGreatestWhereTheRobotIs) {
  const auto map = probabilityMap(region, weighersOf(features), std::vector{start.theta});
  const auto best =
      static_cast<std::size_t>(std::max_element(map.begin(), map.end()) - map.begin());
  EXPECT_LT(distance(centre(best, start.theta), start), 0.15);
}

TEST_F(FieldMaps, SeveralFeaturesMultiply) {
  const auto once = probabilityMap(region, weighersOf(features), std::vector{0.3});
  const auto twice =
      probabilityMap(region, weighersOf(std::vector{scanner, scanner}), std::vector{0.3});
  for (std::size_t cell = 0; cell < once.size(); ++cell)
    EXPECT_NEAR(twice[cell], once[cell] * once[cell], 1e-6);
}

TEST_F(FieldMaps, StopsWhenItsCallerSaysSo) {
  const std::vector<double> headings(10, 0.0);
  std::vector<double> shares;
  const auto map = probabilityMap(region, weighersOf(features), headings, [&](double share) {
    shares.push_back(share);
    return shares.size() < 3;
  });
  EXPECT_TRUE(map.empty());
  EXPECT_EQ(shares.size(), 3U);
}

TEST_F(FieldMaps, TellsHowFarItIsAfterFewCells) {
  const std::vector<double> headings(10, 0.0);
  std::vector<double> shares;
  probabilityMap(region, weighersOf(features), headings, [&](double share) {
    shares.push_back(share);
    return true;
  });
  ASSERT_GT(shares.size(), headings.size()) << "cells are weighed in several calls, too";
  EXPECT_EQ(shares.front(), 0.0);
  EXPECT_EQ(std::adjacent_find(shares.begin(), shares.end(), std::greater_equal<>()), shares.end());
  EXPECT_LT(shares.back(), 1.0);
}

TEST_F(FieldMaps, HeadingsAreThoseOfTheTables) {
  EXPECT_EQ(mapHeadings(robot->tables.headingStep, features).size(), 120U);  // of 3 degrees
  EXPECT_EQ(mapHeadings(2 * kPi, {}), std::vector{0.0});
}

TEST_F(FieldMaps, ExpectationIsWhatTheSensorShouldRead) {
  const ExpectationMap map = expectationMap(region, *scanner, 15, kPi / 2);
  EXPECT_EQ(map.count, 31U);
  for (std::size_t cell = 0; cell < map.values.size(); ++cell) {
    // The middle beam looks along the heading; tables have cells of 0.1 m, and levels of range.
    const Pose2 sensor = centre(cell, kPi / 2) * scanner->mount();
    EXPECT_NEAR(map.values[cell], room.range(sensor.x, sensor.y, sensor.theta), 0.15);
  }
  const ExpectationMap beyond = expectationMap(region, *scanner, 31, 0.0);
  EXPECT_EQ(beyond.count, 31U);
  EXPECT_TRUE(std::isnan(beyond.values[500]));
}

}  // namespace
}  // namespace ortung::test

// Straight walls are found in maps of cells.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "MapWalls.hpp"

namespace ortung {
namespace {

constexpr double kCell = 0.05;  // [m]

/// A map of a rectangular room turned by @p turn around the origin: free inside, walls 0.2 m thick.
GridBody roomMap(double halfX, double halfY, double turn) {
  GridBody body;
  body.zHigh = 2.0;
  GridMap& map = body.map;
  map.cell = kCell;
  map.originX = map.originY = -5.0;
  map.columns = map.rows = 200;
  for (int row = 0; row < map.rows; ++row) {
    for (int column = 0; column < map.columns; ++column) {
      const double x = map.originX + (column + 0.5) * kCell;
      const double y = map.originY + (row + 0.5) * kCell;
      const double u = std::abs(std::cos(turn) * x + std::sin(turn) * y);
      const double v = std::abs(-std::sin(turn) * x + std::cos(turn) * y);
      const bool inside = u < halfX && v < halfY;
      const bool wall = u < halfX + 0.2 && v < halfY + 0.2;
      map.cells.push_back(inside ? GridCell::kFree
                          : wall ? GridCell::kOccupied
                                 : GridCell::kUnknown);
    }
  }
  return body;
}

TEST(MapWalls, AreTheFourOfARoomWhateverItsTurn) {
  for (const double degrees : {0.0, 3.0, 17.0, 30.0, 45.0, 71.0}) {
    const double turn = degrees * std::numbers::pi / 180.0;
    GridBody body = roomMap(3.0, 2.0, turn);
    std::vector<FieldWall> walls;
    addMapWalls(body, walls);
    ASSERT_EQ(walls.size(), 4u) << degrees;
    double length = 0.0;
    for (const FieldWall& wall : walls) {
      length += std::hypot(wall.x1 - wall.x0, wall.y1 - wall.y0);
      EXPECT_EQ(wall.zHigh, 2.0);
      // The room is on its left: the origin lies there, 2 or 3 m away.
      const double dx = wall.x1 - wall.x0;
      const double dy = wall.y1 - wall.y0;
      const double away = (dx * -wall.y0 - dy * -wall.x0) / std::hypot(dx, dy);
      const double expected = std::abs(away - 3.0) < std::abs(away - 2.0) ? 3.0 : 2.0;
      EXPECT_NEAR(away, expected, 0.6 * kCell) << degrees;  // cells are drawn by their middles
      const double direction = std::atan2(dy, dx) - turn;
      EXPECT_NEAR(std::remainder(direction, std::numbers::pi / 2.0), 0.0, 0.015) << degrees;
    }
    EXPECT_NEAR(length, 20.0, 1.0) << degrees;
  }
}

/// Maps made of scans know walls only as far as somebody looked, so outlines end at unknown cells.
TEST(MapWalls, ThatEndAtWhatIsUnknownAreFoundWhicheverWayTheyRun) {
  for (const double degrees : {0.0, 30.0, 45.0}) {
    const double turn = degrees * std::numbers::pi / 180.0;
    GridBody body = roomMap(3.0, 2.0, turn);
    GridMap& map = body.map;
    for (int row = 0; row < map.rows; ++row)
      for (int column = 0; column < map.columns; ++column) {
        const double x = map.originX + (column + 0.5) * kCell;
        const double y = map.originY + (row + 0.5) * kCell;
        const double u = std::abs(std::cos(turn) * x + std::sin(turn) * y);
        const double v = std::abs(-std::sin(turn) * x + std::cos(turn) * y);
        if (u > 2.5 && v > 1.5) map.cells[map.index(column, row)] = GridCell::kUnknown;  // corners
      }
    std::vector<FieldWall> walls;
    addMapWalls(body, walls);
    ASSERT_EQ(walls.size(), 4u) << degrees;
    double length = 0.0;
    for (const FieldWall& wall : walls) length += lengthOf(wall);
    EXPECT_NEAR(length, 2.0 * (5.0 + 3.0), 0.5) << degrees;
  }
}

TEST(MapWalls, LieBehindTheOutlineAsRaysSeeThem) {
  GridBody body = roomMap(3.0, 2.0, 0.0);
  body.surfaceDepth = 0.025;
  std::vector<FieldWall> walls;
  addMapWalls(body, walls);
  ASSERT_EQ(walls.size(), 4u);
  for (const FieldWall& wall : walls) {
    const bool isAlongX = std::abs(wall.y0 - wall.y1) < 0.1;
    EXPECT_NEAR(isAlongX ? std::abs(wall.y0) : std::abs(wall.x0), isAlongX ? 2.025 : 3.025, 0.026);
  }
}

TEST(MapWalls, OfAnEmptyMapAreNone) {
  GridBody body;
  std::vector<FieldWall> walls;
  addMapWalls(body, walls);
  body.map.columns = body.map.rows = 3;
  body.map.cells.assign(9, GridCell::kFree);
  addMapWalls(body, walls);
  body.map.cells.assign(9, GridCell::kOccupied);
  addMapWalls(body, walls);
  EXPECT_TRUE(walls.empty());
}

}  // namespace
}  // namespace ortung

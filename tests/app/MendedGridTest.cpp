// Maps that are mended where readings are sure that they no longer fit.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "MendedGrid.hpp"

namespace ortung::app {
namespace {

/// A map of 10 m x 10 m around the origin with cells of 0.05 m, all of them free.
WorldGrid freeMap() {
  WorldGrid grid{0.05, -5.0, -5.0, 200, 200, std::string(200 * 200, WorldGrid::kFree)};
  return grid;
}

char& at(WorldGrid& grid, double x, double y) {
  const auto column = static_cast<std::size_t>(std::floor((x - grid.originX) / grid.cell));
  const auto row = static_cast<std::size_t>(std::floor((y - grid.originY) / grid.cell));
  return grid.cells.at(row * grid.columns + column);
}

/// Walls around a box, whose inside nobody knows.
void addBox(WorldGrid& grid, double x, double y, double half) {
  const auto reach = static_cast<int>(std::lround(half / 0.05));
  for (int column = -reach; column <= reach; ++column)
    for (int row = -reach; row <= reach; ++row)
      at(grid, x + 0.05 * column + 0.01, y + 0.05 * row + 0.01) =
          std::max(std::abs(column), std::abs(row)) == reach ? WorldGrid::kOccupied
                                                             : WorldGrid::kUnknown;
}

ChangesData::Cell gone(double x, double y, bool isSure = true) {
  return {false, isSure, x, y, 2, 0};
}
ChangesData::Cell fresh(double x, double y, bool isSure = true) {
  return {true, isSure, x, y, 2, 0};
}

std::size_t count(const WorldGrid& grid, char kind) {
  return static_cast<std::size_t>(std::count(grid.cells.begin(), grid.cells.end(), kind));
}

TEST(MendedGrid, StaysWhereNothingIsSure) {
  WorldGrid grid = freeMap();
  addBox(grid, 1.0, 1.0, 0.5);
  const WorldGrid before = grid;
  const MendedCells counts = mend({0.1, {gone(0.5, 1.0, false), fresh(-1.0, 0.0, false)}}, grid);
  EXPECT_EQ(grid.cells, before.cells);
  EXPECT_EQ(counts.freed + counts.occupied, 0U);
}

TEST(MendedGrid, FreesAThinWallWhereItIsGone) {
  WorldGrid grid = freeMap();
  for (double x = -2.0; x < 2.0; x += 0.05) at(grid, x + 0.01, 1.02) = WorldGrid::kOccupied;
  const std::size_t whole = count(grid, WorldGrid::kOccupied);
  ChangesData::Reading changes{0.1, {}};
  for (double x = -0.95; x < 1.0; x += 0.1) changes.cells.push_back(gone(x, 1.03));
  const MendedCells counts = mend(changes, grid);
  EXPECT_EQ(at(grid, 0.01, 1.02), WorldGrid::kFree);
  EXPECT_EQ(at(grid, -0.9, 1.02), WorldGrid::kFree);
  EXPECT_EQ(at(grid, -1.4, 1.02), WorldGrid::kOccupied) << "what was not found gone stays";
  EXPECT_EQ(at(grid, 1.6, 1.02), WorldGrid::kOccupied);
  EXPECT_EQ(counts.freed, whole - count(grid, WorldGrid::kOccupied));
  EXPECT_NEAR(static_cast<double>(counts.freed) * 0.05, 2.2, 0.2) << "2 m and 0.15 m at either end";
}

// Nobody sees the inside of a box, so nobody finds that it is gone.
TEST(MendedGrid, FreesTheInsideOfABoxWhoseSidesAreGone) {
  WorldGrid grid = freeMap();
  addBox(grid, 1.0, 1.0, 0.6);
  ChangesData::Reading changes{0.1, {}};
  for (double d = -0.6; d <= 0.61; d += 0.1)
    for (const double side : {-0.6, 0.6}) {
      changes.cells.push_back(gone(1.0 + d, 1.0 + side));
      changes.cells.push_back(gone(1.0 + side, 1.0 + d));
    }
  mend(changes, grid);
  EXPECT_EQ(count(grid, WorldGrid::kFree), grid.cells.size());
}

TEST(MendedGrid, KeepsABoxOfWhichOneSideIsGone) {
  WorldGrid grid = freeMap();
  addBox(grid, 1.0, 1.0, 0.6);
  ChangesData::Reading changes{0.1, {}};
  for (double d = -0.6; d <= 0.61; d += 0.1) changes.cells.push_back(gone(1.0 + d, 0.4));
  mend(changes, grid);
  EXPECT_EQ(at(grid, 1.0, 0.42), WorldGrid::kFree);
  EXPECT_EQ(at(grid, 1.0, 1.0), WorldGrid::kUnknown);
  EXPECT_EQ(at(grid, 1.0, 1.61), WorldGrid::kOccupied);
}

TEST(MendedGrid, NeverFreesWhatReachesTheEdge) {
  WorldGrid grid = freeMap();
  for (std::size_t row = 0; row < grid.rows; ++row)
    for (std::size_t column = 150; column < grid.columns; ++column)
      grid.cells[row * grid.columns + column] = WorldGrid::kUnknown;
  ChangesData::Reading changes{0.1, {}};
  for (double y = -4.95; y < 5.0; y += 0.1) changes.cells.push_back(gone(2.5, y));
  mend(changes, grid);
  EXPECT_EQ(at(grid, 2.6, 0.0), WorldGrid::kFree);
  EXPECT_EQ(at(grid, 3.0, 0.0), WorldGrid::kUnknown);
}

TEST(MendedGrid, DrawsWhatIsNewAsAWallWithoutGaps) {
  WorldGrid grid = freeMap();
  ChangesData::Reading changes{0.1, {}};
  for (int k = 0; k < 20; ++k)
    changes.cells.push_back(fresh(-1.0 + 0.1 * k, 2.03 + (k % 2 == 0 ? 0.012 : -0.012)));
  changes.cells.push_back(fresh(-4.0, -4.0));
  mend(changes, grid);
  for (double x = -0.9; x < 0.8; x += 0.05)
    EXPECT_TRUE(at(grid, x + 0.01, 2.03) == WorldGrid::kOccupied ||
                at(grid, x + 0.01, 1.98) == WorldGrid::kOccupied)
        << x;
  EXPECT_EQ(at(grid, 1.2, 2.03), WorldGrid::kFree);
  EXPECT_EQ(at(grid, -0.98, 2.03), WorldGrid::kFree) << "its end is the middle of what is around";
  EXPECT_EQ(at(grid, -4.0 + 1e-9, -4.0 + 1e-9), WorldGrid::kOccupied) << "alone";
  EXPECT_LE(count(grid, WorldGrid::kOccupied), 45U) << "it is thin";
}

// Noise lets the beams that meet a wall end in three rows of cells.
TEST(MendedGrid, DrawsAThinWallWhereNoiseMadeItWide) {
  WorldGrid grid = freeMap();
  ChangesData::Reading changes{0.1, {}};
  for (int k = 0; k < 20; ++k)
    for (const double off : {-0.08, 0.0, 0.08})
      changes.cells.push_back(fresh(-1.0 + 0.1 * k, 2.025 + off));
  mend(changes, grid);
  for (double x = -0.8; x < 0.7; x += 0.05)
    EXPECT_EQ(at(grid, x + 0.01, 2.03), WorldGrid::kOccupied) << x;
  EXPECT_LE(count(grid, WorldGrid::kOccupied), 80U) << "two cells, not five";
}

TEST(MendedGrid, IgnoresWhatIsOffTheMap) {
  WorldGrid grid = freeMap();
  const MendedCells counts =
      mend({0.1, {fresh(50.0, 0.0), gone(0.0, -50.0), fresh(5.02, 0.0)}}, grid);
  EXPECT_EQ(counts.freed + counts.occupied, 0U);
}

}  // namespace
}  // namespace ortung::app

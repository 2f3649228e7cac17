// The map that a scanner would make of a world, cell by cell.
#include <gtest/gtest.h>

#include <cmath>

#include "Console.hpp"
#include "Files.hpp"
#include "WorldGrid.hpp"

namespace ortung::app {
namespace {

std::unique_ptr<SimWorld> worldOf(const std::string& toml) {
  const test::TemporaryFolder folder;
  test::writeBytes(folder / "world.toml", toml);
  return readWorld(folder / "world.toml");
}

/// An open field of 8 m x 6 m with a box of 2 m x 2 m around the origin.
const char* const kBox = R"([world]
name = "box"
x_m = [-4, 4]
y_m = [-3, 3]
[[rectangle]]
center_m = [0, 0]
size_m = [2, 2]
z_m = [0, 1]
)";

char cellAt(const WorldGrid& grid, double x, double y) {
  const auto column = static_cast<std::size_t>(std::floor((x - grid.originX) / grid.cell));
  const auto row = static_cast<std::size_t>(std::floor((y - grid.originY) / grid.cell));
  EXPECT_LT(column, grid.columns);
  EXPECT_LT(row, grid.rows);
  return grid.cells.at(row * grid.columns + column);
}

TEST(WorldGrid, SurfacesAreOccupiedTheirInsideIsUnknownAndAllElseIsFree) {
  const WorldGrid grid = drawGrid(*worldOf(kBox), 0.5, 0.3);
  EXPECT_EQ(grid.cells.size(), grid.columns * grid.rows);
  std::size_t occupied = 0;
  std::size_t unknown = 0;
  for (double x = -3.75; x < 4.0; x += 0.5) {
    for (double y = -2.75; y < 3.0; y += 0.5) {
      const double depth = 1.0 - std::max(std::abs(x), std::abs(y));  // within the box
      const char expected = depth < 0.0   ? WorldGrid::kFree
                            : depth < 0.5 ? WorldGrid::kOccupied
                                          : WorldGrid::kUnknown;
      EXPECT_EQ(cellAt(grid, x, y), expected) << x << " " << y;
      occupied += expected == WorldGrid::kOccupied ? 1 : 0;
      unknown += expected == WorldGrid::kUnknown ? 1 : 0;
    }
  }
  EXPECT_EQ(occupied, 12u);
  EXPECT_EQ(unknown, 4u);
}

TEST(WorldGrid, CoversTheWorldAndTwoCellsAroundAtMultiplesOfACell) {
  const auto world = worldOf(kBox);
  const WorldGrid grid = drawGrid(*world, 0.5, 0.3);
  const Box2 bounds = world->solids().bounds;
  EXPECT_NEAR(grid.originX / 0.5, std::round(grid.originX / 0.5), 1e-9);
  EXPECT_NEAR(grid.originY / 0.5, std::round(grid.originY / 0.5), 1e-9);
  const double right = grid.originX + 0.5 * static_cast<double>(grid.columns);
  const double upper = grid.originY + 0.5 * static_cast<double>(grid.rows);
  for (const double room : {bounds.xLow - grid.originX, bounds.yLow - grid.originY,
                            right - bounds.xHigh, upper - bounds.yHigh}) {
    EXPECT_GE(room, 1.0 - 1e-9);
    EXPECT_LT(room, 1.5);
  }
}

TEST(WorldGrid, AScannerAboveALowBoxDoesNotSeeIt) {
  const auto world = worldOf(kBox);
  EXPECT_EQ(cellAt(drawGrid(*world, 0.5, 0.9), 0.75, 0.25), WorldGrid::kOccupied);
  const WorldGrid above = drawGrid(*world, 0.5, 1.1);
  EXPECT_EQ(above.cells.find(WorldGrid::kOccupied), std::string::npos);
}

TEST(WorldGrid, TooManyCellsAreRefusedWithTheirNumber) {
  const auto world = worldOf(
      "[world]\nname = \"plain\"\nx_m = [0, 50]\ny_m = [0, 100]\n[[landmark]]\n"
      "kind = \"post\"\nidentity = 1\nposition_m = [1, 1]\n");
  const std::string message = test::messageOf<UsageError>([&] { drawGrid(*world, 0.005, 0.3); });
  EXPECT_TRUE(message.starts_with("--cell 0.005 makes a map of ")) << message;
  EXPECT_TRUE(message.ends_with(" cells, expected at most 67108864")) << message;
}

}  // namespace
}  // namespace ortung::app

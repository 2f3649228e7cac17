// Occupancy grids: rays against a brute-force test of every occupied cell, and what free space is.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "WorldFiles.hpp"
#include "ortung/base/Random.hpp"

namespace ortung::test {
namespace {

constexpr double kCell = 0.25;

std::unique_ptr<SimWorld> gridOf(const std::vector<std::string>& rows, const std::string& more = "",
                                 const std::string& origin = "[0, 0, 0]") {
  const TemporaryFolder folder;
  folder.write("map.pgm", pgmOf(rows));
  folder.write("map.yaml", mapYaml("map.pgm", origin, "0.25"));
  return readWorld(folder.write("world.toml", gridWorld("map.yaml", more)));
}

std::vector<std::string> randomRows(std::size_t columns, std::size_t rows, Random& random) {
  std::vector<std::string> image(rows, std::string(columns, '.'));
  for (std::string& row : image)
    for (char& cell : row) cell = random.uniform() < 0.12 ? '#' : '.';
  return image;
}

/// Where a ray enters the first occupied cell, by asking all of them.
double bruteForce(const std::vector<std::string>& rows, double x, double y, double angle,
                  double most) {
  const double dx = std::cos(angle);
  const double dy = std::sin(angle);
  double nearest = most;
  for (std::size_t r = 0; r < rows.size(); ++r) {
    for (std::size_t c = 0; c < rows[r].size(); ++c) {
      if (rows[rows.size() - 1 - r][c] != '#') continue;
      const double x0 = (static_cast<double>(c) * kCell - x) / dx;
      const double x1 = (static_cast<double>(c + 1) * kCell - x) / dx;
      const double y0 = (static_cast<double>(r) * kCell - y) / dy;
      const double y1 = (static_cast<double>(r + 1) * kCell - y) / dy;
      const double enter = std::max(std::min(x0, x1), std::min(y0, y1));
      const double leave = std::min(std::max(x0, x1), std::max(y0, y1));
      if (enter >= 0 && enter <= leave) nearest = std::min(nearest, enter);
    }
  }
  return nearest;
}

TEST(Grid, RaysMeetTheOutlinesOfOccupiedCells) {
  Random random(7);
  const auto rows = randomRows(40, 30, random);
  const auto world = gridOf(rows);
  int compared = 0;
  int exact = 0;
  while (compared < 4000) {
    const double x = random.uniform(0, 40 * kCell);
    const double y = random.uniform(0, 30 * kCell);
    if (!world->isFree(x, y, {0})) continue;
    const double angle = random.uniform(-3.1, 3.1);
    const double found = rangeAt(*world, x, y, angle, 0.3, 20);
    const double here = bruteForce(rows, x, y, angle, 20);
    // A ray that grazes a corner may or may not meet it: both neighbours of it are right.
    const double left = bruteForce(rows, x, y, angle - 1e-5, 20);
    const double right = bruteForce(rows, x, y, angle + 1e-5, 20);
    ASSERT_GE(found, std::min({here, left, right}) - 1e-4) << x << " " << y << " " << angle;
    ASSERT_LE(found, std::max({here, left, right}) + 1e-4) << x << " " << y << " " << angle;
    exact += std::abs(found - here) < 1e-4 ? 1 : 0;
    ++compared;
  }
  EXPECT_GE(exact, 3990);
}

TEST(Grid, RaysDoNotSlipThroughTheCornersOfAClosedRoom) {
  const std::vector<std::string> rows{"#####", "#...#", "#...#", "#...#", "#####"};
  const auto world = gridOf(rows);
  for (const double toX : {1, 4})
    for (const double toY : {1, 4})
      for (int i = -50; i <= 50; ++i) {
        const double angle = std::atan2(toY * kCell - 0.6, toX * kCell - 0.7) + i * 1e-8;
        ASSERT_LT(rangeAt(*world, 0.7, 0.6, angle, 0.3, 20), 1.0) << toX << toY << i;
      }
}

TEST(Grid, RaysPassOverWhatIsLow) {
  const auto world = gridOf({"..#.."}, "z_m = [0, 0.4]\n");
  EXPECT_NEAR(rangeAt(*world, 0.1, 0.1, 0, 0.3), 0.4, 1e-5);
  EXPECT_EQ(rangeAt(*world, 0.1, 0.1, 0, 0.5), 50.0);
}

TEST(Grid, RaysThatFallMeetTheTopsOfOccupiedCells) {
  const auto world = gridOf({"....", ".##.", ".##.", ".#..", "...."}, "z_m = [0, 0.5]\n");
  for (const auto& [x, y] : {std::pair{0.3, 0.3}, {0.3, 0.6}, {0.7, 0.9}, {0.3, 0.9}}) {
    float range = 0;  // from 2 m to one side and 2 m above the top, down by 45 degrees
    world->castFan({.x = x - 2,
                    .y = y,
                    .z = 2.5,
                    .firstAngle = 0,
                    .angleStep = 0,
                    .elevation = -std::numbers::pi / 4,
                    .maxRange = 20},
                   0, {&range, 1});
    EXPECT_NEAR(static_cast<double>(range), std::sqrt(8.0), 1e-4) << x << " " << y;
  }
}

TEST(Grid, TopsReachToTheEdgesOfTheMap) {
  const auto world = gridOf({"##.#", ".###", "####", "####"}, "z_m = [0, 0.5]\n");
  for (const auto& [column, row] :
       {std::pair{0, 0}, {3, 0}, {0, 1}, {3, 1}, {2, 2}, {0, 3}, {3, 3}}) {
    float range = 0;  // from 2 m above the top, nearly straight down
    world->castFan({.x = (column + 0.5) * kCell,
                    .y = (row + 0.5) * kCell,
                    .z = 2.5,
                    .firstAngle = 0,
                    .angleStep = 0,
                    .elevation = 0.01 - std::numbers::pi / 2,
                    .maxRange = 20},
                   0, {&range, 1});
    EXPECT_NEAR(static_cast<double>(range), 2.0 / std::cos(0.01), 1e-4) << column << " " << row;
  }
}

TEST(Grid, LiesWhereItsOriginSays) {
  const auto world = gridOf({"#...", "...."}, "", "[-3, 5, 0]");
  EXPECT_FALSE(world->isFree(-2.9, 5.4, {0}));  // the image's top row is the grid's last
  EXPECT_TRUE(world->isFree(-2.9, 5.1, {0}));
  const FieldRegion region = world->region(0.25, {0});
  EXPECT_EQ(region.grid, (FieldGrid{-3, 5, 0.25, 4, 2}));
  EXPECT_EQ(region.open, (std::vector<std::uint8_t>{1, 1, 1, 1, 0, 1, 1, 1}));
}

TEST(Grid, CirclesAreFreeExactlyWhereNoOccupiedCellIsWithinTheirRadius) {
  Random random(11);
  const auto rows = randomRows(30, 30, random);
  const auto world = gridOf(rows);
  for (int i = 0; i < 20000; ++i) {
    const double x = random.uniform(0, 30 * kCell);
    const double y = random.uniform(0, 30 * kCell);
    const double radius = random.uniform(0, 0.8);
    double nearest =
        std::min(std::min(x, 30 * kCell - x), std::min(y, 30 * kCell - y));  // the edge
    for (std::size_t r = 0; r < 30; ++r)
      for (std::size_t c = 0; c < 30; ++c) {
        if (rows[29 - r][c] != '#') continue;
        const double left = static_cast<double>(c) * kCell;
        const double low = static_cast<double>(r) * kCell;
        nearest = std::min(nearest, std::hypot(std::max({0.0, left - x, x - left - kCell}),
                                               std::max({0.0, low - y, y - low - kCell})));
      }
    if (std::abs(nearest - radius) < 1e-9) continue;
    ASSERT_EQ(world->isFree(x, y, {radius}), nearest > radius) << x << " " << y << " " << radius;
  }
}

TEST(Grid, UnknownCellsNearFreeOnesAreOpenButNotThoseBehindWalls) {
  const auto world = gridOf({"..    #    "}, "unknown_margin_m = 0.5\n");
  const auto open = world->region(0.25, {0}).open;
  EXPECT_EQ(open, (std::vector<std::uint8_t>{1, 1, 1, 1, 0, 0, 0, 0, 0, 0, 0}));
  const auto behind = gridOf({".#     "}, "unknown_margin_m = 0.5\n")->region(0.25, {0}).open;
  EXPECT_EQ(behind, (std::vector<std::uint8_t>{1, 0, 0, 0, 0, 0, 0}));
  const auto none = gridOf({".. "}, "unknown_margin_m = 0\n")->region(0.25, {0}).open;
  EXPECT_EQ(none, (std::vector<std::uint8_t>{1, 1, 0}));
}

// Two cells around the only free one, wherever that is; rows do not go on in their neighbours.
TEST(Grid, UnknownCellsNearAFreeOneAreThoseInTheCircle) {
  constexpr int kColumns = 6;
  constexpr int kRows = 5;
  for (int row = 0; row < kRows; ++row)
    for (int column = 0; column < kColumns; ++column) {
      std::vector<std::string> image(kRows, std::string(kColumns, ' '));
      image[static_cast<std::size_t>(kRows - 1 - row)][static_cast<std::size_t>(column)] = '.';
      std::vector<std::uint8_t> expected;
      for (int r = 0; r < kRows; ++r)
        for (int c = 0; c < kColumns; ++c)
          expected.push_back((r - row) * (r - row) + (c - column) * (c - column) <= 4 ? 1 : 0);
      EXPECT_EQ(gridOf(image, "unknown_margin_m = 0.5\n")->region(0.25, {0}).open, expected)
          << column << " " << row;
    }
}

TEST(Grid, UnknownCellsAreTransparentAndNotSolid) {
  const auto world = gridOf({".   #"});
  EXPECT_NEAR(rangeAt(*world, 0.1, 0.1, 0), 0.9, 1e-5);
}

}  // namespace
}  // namespace ortung::test

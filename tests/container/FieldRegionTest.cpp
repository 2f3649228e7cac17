// Which cells a sweep stands in.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "Seeded.hpp"
#include "ortung/tables/FieldRegion.hpp"

namespace ortung {
namespace {

FieldRegion floorOf(int columns, int rows, double cell) {
  FieldRegion region;
  region.grid = {-1.0, 2.0, cell, columns, rows};
  region.open.assign(region.grid.size(), 1);
  region.standable = region.open;
  return region;
}

TEST(OpenCellsApart, AreAllCellsWhereNoneMayBeLeftOut) {
  const FieldRegion region = floorOf(7, 4, 0.1);
  std::vector<std::size_t> all(region.grid.size());
  std::iota(all.begin(), all.end(), 0U);
  EXPECT_EQ(openCellsApart(region, 0.0), all);
  EXPECT_EQ(openCellsApart(region, 0.19), all);
}

TEST(OpenCellsApart, AreTheMiddlesOfBlocks) {
  EXPECT_EQ(openCellsApart(floorOf(6, 3, 0.1), 0.3), (std::vector<std::size_t>{7, 10}));
}

TEST(OpenCellsApart, AreOneForAFloorSmallerThanTheSpacing) {
  EXPECT_EQ(openCellsApart(floorOf(3, 3, 0.1), 1e9).size(), 1U);
}

RC_GTEST_PROP(OpenCellsApartProperty, LeaveNoOpenCellFarFromOneThatIsSeenFrom, ()) {
  FieldRegion region = floorOf(*rc::gen::inRange(1, 30), *rc::gen::inRange(1, 30), 0.1);
  for (std::uint8_t& open : region.open) open = *rc::gen::inRange<std::uint8_t>(0, 2);
  const double spacing = *rc::gen::inRange(0, 80) / 100.0;
  const std::vector<std::size_t> cells = openCellsApart(region, spacing);
  RC_ASSERT(std::is_sorted(cells.begin(), cells.end()));
  RC_ASSERT(std::adjacent_find(cells.begin(), cells.end()) == cells.end());
  for (const std::size_t cell : cells) RC_ASSERT(region.open[cell] == 1);
  const FieldGrid& grid = region.grid;
  const double within = std::max(spacing, grid.cell) * (1.0 + 1e-9);
  for (std::size_t cell = 0; cell < grid.size(); ++cell) {
    if (region.open[cell] == 0) continue;
    const bool isNear = std::any_of(cells.begin(), cells.end(), [&](std::size_t other) {
      return std::abs(grid.centreX(cell) - grid.centreX(other)) < within &&
             std::abs(grid.centreY(cell) - grid.centreY(other)) < within;
    });
    RC_ASSERT(isNear);
  }
}

}  // namespace
}  // namespace ortung

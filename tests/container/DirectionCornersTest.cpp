// What a table by cell and direction knows between the centres of its cells and between its
// directions.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "DirectionCorners.hpp"
#include "FakeRoom.hpp"

namespace ortung {
namespace {

constexpr int kDirections = 8;
constexpr double kCell = 0.5;

/// Its level is that of a plane over columns and rows, plus 20 a direction.
DirectionTable table(const FieldRegion& region) {
  DirectionTable made;
  made.start(region, kDirections, 1);
  for (std::size_t cell = 0; cell < region.grid.size(); ++cell)
    for (int direction = 0; direction < kDirections; ++direction) {
      const int column = static_cast<int>(cell) % region.grid.columns;
      const int row = static_cast<int>(cell) / region.grid.columns;
      made.learn(region.grid.centreX(cell), region.grid.centreY(cell),
                 direction * kTurn / kDirections,
                 static_cast<std::uint8_t>(3 * column + 7 * row + 20 * direction));
    }
  made.finish();
  return made;
}

TEST(DirectionCorners, WeighTheEightEntriesAroundByTheirSharesOfThePlace) {
  const FieldRegion region = test::Room{4.0, 3.0}.region(kCell, 0.1);
  const DirectionTable levels = table(region);
  DirectionCorners corners(levels, 0.0F);
  Random random(11);
  for (int i = 0; i < 500; ++i) {
    // Between the outermost centres, and from the first direction to the last.
    const double column = random.uniform(0.0, region.grid.columns - 1.001);
    const double row = random.uniform(0.0, region.grid.rows - 1.001);
    const double turn = random.uniform(0.0, kDirections - 1.001);
    const auto x = static_cast<float>(region.grid.originX + (column + 0.5) * kCell);
    const auto y = static_cast<float>(region.grid.originY + (row + 0.5) * kCell);
    const auto theta = static_cast<float>(turn * kTurn / kDirections);
    corners.start({&x, &y, &theta}, 1);
    LevelsAround around;
    ASSERT_TRUE(corners.around(0, around));
    const auto shareOf = [](double place) {
      const double beyond = place - std::floor(place);
      return std::array<double, 2>{1.0 - beyond, beyond};
    };
    const auto xs = shareOf(column), ys = shareOf(row), turns = shareOf(turn);
    double mean = 0.0;
    for (std::size_t c = 0; c < LevelsAround::kCells; ++c)
      for (std::size_t d = 0; d < 2; ++d) {
        const double weight = around.weights[2 * c + d] / double{LevelsAround::kWhole};
        EXPECT_NEAR(weight, xs[c % 2] * ys[c / 2] * turns[d], 1.01 / LevelsAround::kWhole)
            << "cell " << c << ", direction " << d;
        mean += weight * around.rows[c][d];
      }
    EXPECT_EQ(std::accumulate(around.weights.begin(), around.weights.end(), 0),
              LevelsAround::kWhole);
    const double plane = 3.0 * column + 7.0 * row + 20.0 * turn;
    EXPECT_NEAR(mean, plane, 30.0 * 1.01 / LevelsAround::kWhole * 4) << "rounded weights";
  }
}

TEST(DirectionCorners, KnowNothingOutside) {
  const FieldRegion region = test::Room{4.0, 3.0}.region(kCell, 0.1);
  const DirectionTable levels = table(region);
  DirectionCorners corners(levels, 0.0F);
  for (const auto& [x, y] : {std::pair{2.01F, 0.0F},
                             {-2.01F, 0.0F},
                             {0.0F, 1.51F},
                             {0.0F, -1.51F},
                             {std::nanf(""), 0.0F}}) {
    const float theta = 0.0F;
    corners.start({&x, &y, &theta}, 1);
    LevelsAround around;
    EXPECT_FALSE(corners.around(0, around)) << x << " " << y;
  }
}

}  // namespace
}  // namespace ortung

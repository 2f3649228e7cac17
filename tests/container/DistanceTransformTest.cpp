#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "ortung/base/Random.hpp"
#include "ortung/tables/DistanceTransform.hpp"

namespace ortung {
namespace {

/// By looking at all marked cells.
double nearest(const std::vector<std::uint8_t>& marked, int columns, int column, int row) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < marked.size(); ++i) {
    if (marked[i] == 0) continue;
    const double dx = static_cast<int>(i) % columns - column;
    const double dy = static_cast<int>(i) / columns - row;
    least = std::min(least, dx * dx + dy * dy);
  }
  return least;
}

void expectNearestEverywhere(const std::vector<std::uint8_t>& marked, int columns, int rows) {
  DistanceTransform distances(columns, rows, marked);
  for (int row = 0; row < rows; ++row) {
    const auto squared = distances.squaredOf(row);
    ASSERT_EQ(squared.size(), static_cast<std::size_t>(columns));
    for (int column = 0; column < columns; ++column)
      ASSERT_EQ(squared[static_cast<std::size_t>(column)], nearest(marked, columns, column, row))
          << "column " << column << ", row " << row << " of " << columns << " x " << rows;
  }
}

TEST(DistanceTransform, FindsTheNearestOfAllMarkedCells) {
  Random random(7, 0);
  const int sizes[][2] = {{1, 1}, {1, 40}, {40, 1}, {23, 17}, {12, 31}};
  for (const auto& [columns, rows] : sizes) {
    for (const double share : {0.01, 0.1, 0.6}) {
      std::vector<std::uint8_t> marked(static_cast<std::size_t>(columns * rows));
      for (std::uint8_t& cell : marked) cell = random.uniform() < share ? 1 : 0;
      expectNearestEverywhere(marked, columns, rows);
    }
  }
}

TEST(DistanceTransform, IsInfiniteWhereNothingIsMarked) {
  expectNearestEverywhere(std::vector<std::uint8_t>(30), 6, 5);
}

}  // namespace
}  // namespace ortung

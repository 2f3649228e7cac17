#include "ortung/tables/FieldRegion.hpp"

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <string>

namespace ortung {

void FieldRegion::check() const {
  if (!(grid.cell > 0.0) || !std::isfinite(grid.cell) || !std::isfinite(grid.originX) ||
      !std::isfinite(grid.originY) || grid.columns <= 0 || grid.rows <= 0) {
    throw std::invalid_argument("field region: the grid must have cells of positive, finite size");
  }
  if (open.size() != grid.size() || standable.size() != grid.size()) {
    throw std::invalid_argument("field region: masks of " + std::to_string(open.size()) + " and " +
                                std::to_string(standable.size()) + " cells, expected " +
                                std::to_string(grid.size()));
  }
  if (std::find(standable.begin(), standable.end(), 1) == standable.end()) {
    throw std::invalid_argument("field region: there is no cell where the robot can stand");
  }
  building.check();
}

std::vector<std::size_t> openCellsApart(const FieldRegion& region, double spacing) {
  const FieldGrid& grid = region.grid;
  const int edge = static_cast<int>(std::clamp(spacing / grid.cell + 1e-6, 1.0, 1e4));
  std::vector<std::size_t> cells;
  const auto addNearestToMiddle = [&](int firstColumn, int firstRow) {
    int least = std::numeric_limits<int>::max();
    std::size_t nearest = 0;
    for (int row = firstRow; row < std::min(firstRow + edge, grid.rows); ++row)
      for (int column = firstColumn; column < std::min(firstColumn + edge, grid.columns);
           ++column) {
        const std::size_t cell =
            static_cast<std::size_t>(row) * static_cast<std::size_t>(grid.columns) +
            static_cast<std::size_t>(column);
        if (region.open[cell] == 0) continue;
        const int x = 2 * (column - firstColumn) + 1 - edge;  // in half cells
        const int y = 2 * (row - firstRow) + 1 - edge;
        if (x * x + y * y >= least) continue;
        least = x * x + y * y;
        nearest = cell;
      }
    if (least < std::numeric_limits<int>::max()) cells.push_back(nearest);
  };
  for (int row = 0; row < grid.rows; row += edge)
    for (int column = 0; column < grid.columns; column += edge) addNearestToMiddle(column, row);
  std::sort(cells.begin(), cells.end());
  return cells;
}

}  // namespace ortung

#include "CellCorners.hpp"

#include <algorithm>

#include "ortung/base/Widest.hpp"

namespace ortung {
namespace {

ORTUNG_INLINE float bounded(float place, float most) {
  const float least = place > 0.0F ? place : 0.0F;  // also for NaN
  return least < most ? least : most;
}

}  // namespace

CellCorners::Grid::Grid(const FieldGrid& grid)
    : lookup(grid),
      originX(static_cast<float>(grid.originX + 0.5 * grid.cell)),
      originY(static_cast<float>(grid.originY + 0.5 * grid.cell)),
      perMetre(static_cast<float>(1.0 / grid.cell)),
      columns(grid.columns),
      right(grid.columns > 1 ? 1 : 0),
      up(grid.rows > 1 ? grid.columns : 0),
      mostColumns(static_cast<float>(std::max(0, grid.columns - 1))),
      mostRows(static_cast<float>(std::max(0, grid.rows - 1))),
      lastColumn(static_cast<float>(std::max(0, grid.columns - 2))),
      lastRow(static_cast<float>(std::max(0, grid.rows - 2))) {}

CellCorners::CellCorners(const FieldGrid& grid) : grid_(grid) {}

struct CellCorners::Start {
  ORTUNG_INLINE static void run(CellCorners* found, SensorPoses poses, std::size_t n) {
    const Grid grid = found->grid_;  // shares no memory with what is written
    for (std::size_t k = 0; k < n; ++k) found->own_[k] = grid.lookup.index(poses.x[k], poses.y[k]);
    for (std::size_t k = 0; k < n; ++k) {
      const float column = bounded((poses.x[k] - grid.originX) * grid.perMetre, grid.mostColumns);
      const float row = bounded((poses.y[k] - grid.originY) * grid.perMetre, grid.mostRows);
      const auto left =
          static_cast<std::int32_t>(column < grid.lastColumn ? column : grid.lastColumn);
      const auto below = static_cast<std::int32_t>(row < grid.lastRow ? row : grid.lastRow);
      found->lowest_[k] = below * grid.columns + left;
      found->shareX_[k] = column - static_cast<float>(left);
      found->shareY_[k] = row - static_cast<float>(below);
    }
  }
};

void CellCorners::start(const SensorPoses& poses, std::size_t n) {
  runWidest<Start>(this, poses, n);
}

}  // namespace ortung

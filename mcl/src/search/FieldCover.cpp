#include "FieldCover.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace ortung {

FieldCover::FieldCover(const FieldRegion& region, double metres) {
  const FieldGrid& grid = region.grid;
  const int edge = std::max(1, static_cast<int>(std::lround(metres / grid.cell)));
  spacing = edge * grid.cell;
  const int columns = (grid.columns + edge - 1) / edge;
  const int rows = (grid.rows + edge - 1) / edge;
  constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();
  struct Nearest {
    int squared = std::numeric_limits<int>::max();
    std::size_t cell = kNone;
  };
  std::vector<Nearest> blocks(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows));
  for (std::size_t cell = 0; cell < region.standable.size(); ++cell) {
    if (region.standable[cell] == 0) continue;
    const int column = static_cast<int>(cell % static_cast<std::size_t>(grid.columns));
    const int row = static_cast<int>(cell / static_cast<std::size_t>(grid.columns));
    const int across = 2 * (column % edge) - edge + 1;
    const int along = 2 * (row % edge) - edge + 1;
    const int squared = across * across + along * along;
    Nearest& block =
        blocks[static_cast<std::size_t>(row / edge) * static_cast<std::size_t>(columns) +
               static_cast<std::size_t>(column / edge)];
    if (squared < block.squared) block = {squared, cell};
  }
  for (const Nearest& block : blocks)
    if (block.cell != kNone) cells.push_back(static_cast<std::uint32_t>(block.cell));
}

}  // namespace ortung

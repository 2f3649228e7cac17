#include "LandmarkLevels.hpp"

#include <algorithm>

namespace ortung {

LandmarkLevels::LandmarkLevels(std::span<const Tables> landmarks) {
  const std::size_t count = landmarks.size();
  if (count == 0) return;
  const FieldGrid& grid = landmarks.front().range.cells().grid();
  const std::size_t cells = grid.size();
  const auto isLearned = [&](const CellTable& table) { return table.levels().size() == cells; };
  const bool areLearned = std::all_of(landmarks.begin(), landmarks.end(), [&](const Tables& one) {
    return isLearned(one.range.cells()) && isLearned(one.bearing.cells());
  });
  const std::size_t most = kMostBytes / (2 * count * sizeof(std::uint32_t) + 1);
  if (cells == 0 || cells > most || !areLearned) return;
  stride_ = static_cast<std::uint32_t>(2 * count);
  entries_.resize(cells * stride_);
  for (std::size_t i = 0; i < count; ++i) {
    const auto ranges = landmarks[i].range.cells().levels();
    const auto bearings = landmarks[i].bearing.cells().levels();
    const auto columns = static_cast<std::size_t>(grid.columns);
    for (std::size_t cell = 0; cell < cells; ++cell) {
      const std::size_t right = (cell + 1) % columns == 0 ? cell : cell + 1;
      std::uint32_t* pair = entries_.data() + cell * stride_ + 2 * i;
      pair[0] = ranges[cell] | std::uint32_t{bearings[cell]} << 16;
      pair[1] = ranges[right] | std::uint32_t{bearings[right]} << 16;
    }
  }
  findWhole(grid);
}

void LandmarkLevels::findWhole(const FieldGrid& grid) {
  const auto columns = static_cast<std::size_t>(grid.columns);
  std::vector<std::uint8_t> knows(grid.size());  // the cell and the one at its right
  for (std::size_t cell = 0; cell < knows.size(); ++cell) {
    const auto entries = std::span(entries_).subspan(cell * stride_, stride_);
    const bool knowsAll = std::none_of(entries.begin(), entries.end(), [](std::uint32_t entry) {
      return (entry & 0xFFFF) == CellTable::kNone || entry >> 16 == CellTable::kNone;
    });
    knows[cell] = knowsAll ? 1 : 0;
  }
  isWhole_.resize(knows.size());
  for (std::size_t cell = 0; cell < knows.size(); ++cell) {
    const std::size_t above = cell + columns < knows.size() ? cell + columns : cell;
    isWhole_[cell] = knows[cell] & knows[above];
  }
}

}  // namespace ortung

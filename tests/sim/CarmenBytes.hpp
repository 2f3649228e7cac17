#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

namespace ortung::test {

template <class T>
std::string bytesOf(T value) {
  std::string bytes(sizeof value, '\0');
  std::memcpy(bytes.data(), &value, sizeof value);
  return bytes;
}

/// A CARMEN map with a creator chunk before the grid. Cells: columns from left to right, each
/// upwards.
inline std::string carmenMap(std::int32_t columns, std::int32_t rows, float resolution,
                             const std::vector<float>& cells) {
  std::string grid = "GRIDMAP   " + bytesOf(columns) + bytesOf(rows) + bytesOf(resolution);
  for (const float cell : cells) grid += bytesOf(cell);
  const std::string creator(178, ' ');
  return "# a map\n#\nCARMENMAPFILEv020" + std::string(1, '\x20') +
         bytesOf(static_cast<std::int32_t>(creator.size())) + creator + std::string(1, '\x01') +
         bytesOf(static_cast<std::int32_t>(grid.size())) + grid;
}

}  // namespace ortung::test

#include "GridMap.hpp"

#include <algorithm>
#include <cmath>

#include "ortung/base/FileKind.hpp"
#include "ortung/tables/DistanceTransform.hpp"

namespace ortung {
namespace {

constexpr double kFarthest = 1e4;  ///< greatest coordinate [m]

struct Spread {
  int column, row;              ///< a cell that was reached
  int sourceColumn, sourceRow;  ///< the free cell from which it was reached
};

/// Refuses what lies too far away.
void checkBox(const std::filesystem::path& file, const Box2& box) {
  const bool isNear = box.xLow >= -kFarthest && box.yLow >= -kFarthest && box.xHigh <= kFarthest &&
                      box.yHigh <= kFarthest;
  if (!isNear) throw MapError(file.string() + ": the map reaches beyond 10 km from the origin");
}

using Reader = GridMap (*)(const std::filesystem::path&);

/// Returns what reads a map, by the ending of its name, or by its content; nullptr: nothing does.
Reader readerOf(const std::filesystem::path& file) {
  const auto endsIn = [name = file.filename().string()](const std::string& end) {
    return name.size() > end.size() && name.ends_with(end);
  };
  if (endsIn(".yaml") || endsIn(".yml")) return readMapServer;
  if (endsIn(".gridmap") || endsIn(".gridmap.gz")) return readMrptGridMap;
  for (const char* end : {".map", ".cmf", ".carmen", ".map.gz", ".cmf.gz", ".carmen.gz"})
    if (endsIn(end)) return readCarmenMap;
  return kindOfFile(file) == FileKind::kMapServer ? readMapServer : nullptr;
}

}  // namespace

void checkPlace(const std::filesystem::path& file, const GridMap& map) {
  checkBox(file, map.bounds());
}

void checkGrid(const std::filesystem::path& file, double columns, double rows, double cell,
               double originX, double originY) {
  const auto refuse = [&](const std::string& what) { throw MapError(file.string() + ": " + what); };
  if (!(columns >= 1 && rows >= 1 && columns * rows <= static_cast<double>(kMaxGridCells)))
    refuse("the map has " + std::to_string(static_cast<long long>(columns)) + " x " +
           std::to_string(static_cast<long long>(rows)) + " cells, expected 1 to 2^26 in all");
  if (!(cell >= 0.001 && cell <= 100.0))
    refuse("the resolution is " + std::to_string(cell) + " m, expected 0.001 to 100");
  checkBox(file, {originX, originX + columns * cell, originY, originY + rows * cell});
}

void markUnknownNearFree(GridMap& map, double margin) {
  const double reach = margin / map.cell;
  std::vector<Spread> front;
  const auto visit = [&](const Spread& from, int column, int row) {
    if (column < 0 || row < 0 || column >= map.columns || row >= map.rows) return;
    GridCell& cell = map.cells[map.index(column, row)];
    const double dx = column - from.sourceColumn;
    const double dy = row - from.sourceRow;
    if (cell != GridCell::kUnknown || dx * dx + dy * dy > reach * reach) return;
    cell = GridCell::kUnknownNearFree;
    front.push_back({column, row, from.sourceColumn, from.sourceRow});
  };
  const auto visitNeighbours = [&](const Spread& from) {
    visit(from, from.column - 1, from.row);
    visit(from, from.column + 1, from.row);
    visit(from, from.column, from.row - 1);
    visit(from, from.column, from.row + 1);
  };
  for (int row = 0; row < map.rows; ++row)
    for (int column = 0; column < map.columns; ++column)
      if (map.at(column, row) == GridCell::kFree) visitNeighbours({column, row, column, row});
  while (!front.empty()) {  // ring by ring
    std::vector<Spread> ring;
    ring.swap(front);
    for (const Spread& from : ring) visitNeighbours(from);
  }
}

std::vector<float> distanceToOccupied(const GridMap& map) {
  std::vector<std::uint8_t> occupied(map.cells.size());
  std::transform(map.cells.begin(), map.cells.end(), occupied.begin(),
                 [](GridCell cell) { return cell == GridCell::kOccupied ? 1 : 0; });
  DistanceTransform distances(map.columns, map.rows, occupied);
  std::vector<float> result;
  result.reserve(map.cells.size());
  for (int row = 0; row < map.rows; ++row) {
    for (const double squared : distances.squaredOf(row))
      result.push_back(static_cast<float>(std::sqrt(squared)));
  }
  return result;
}

bool isGridMap(const std::filesystem::path& file) { return readerOf(file) != nullptr; }

GridMap readGridMap(const std::filesystem::path& file) {
  if (const auto read = readerOf(file)) return read(file);
  throw MapError(file.string() +
                 ": is not a known kind of map, expected a map_server map (.yaml, .yml), "
                 "a CARMEN map (.map, .cmf, .carmen, also with .gz) or an MRPT grid map (.gridmap, "
                 ".gridmap.gz)" +
                 whatItIs(file));
}

}  // namespace ortung

#include "GridMap.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace ortung {
namespace {

constexpr double kFarthest = 1e4;  ///< [m], of any coordinate

/// Distance in cells, along each column, to the nearest occupied cell; far: there is none.
std::vector<int> distanceInColumn(const GridMap& map, int far) {
  std::vector<int> distance(map.cells.size(), far);
  const auto sweep = [&](int row, int previous) {
    for (int column = 0; column < map.columns; ++column) {
      int& here = distance[map.index(column, row)];
      if (map.at(column, row) == GridCell::occupied) {
        here = 0;
      } else if (previous >= 0 && previous < map.rows) {
        here = std::min(here, distance[map.index(column, previous)] + 1);
      }
    }
  };
  for (int row = 0; row < map.rows; ++row) sweep(row, row - 1);
  for (int row = map.rows - 1; row >= 0; --row) sweep(row, row + 1);
  return distance;
}

/// Lower envelope of the parabolas (x - q)^2 + height[q]^2 (P. Felzenszwalb, D. Huttenlocher,
/// "Distance Transforms of Sampled Functions", 2012).
class Envelope {
 public:
  explicit Envelope(std::size_t n) : place_(n), from_(n + 1) {}

  void build(const int* height, int n, int far) {
    count_ = 0;
    for (int q = 0; q < n; ++q) {
      if (height[q] >= far) continue;
      double start = -std::numeric_limits<double>::infinity();
      while (count_ > 0) {
        start = crossing(height, place_[count_ - 1], q);
        if (start > from_[count_ - 1]) break;
        --count_;
        start = -std::numeric_limits<double>::infinity();
      }
      place_[count_] = q;
      from_[count_] = start;
      ++count_;
    }
  }
  void read(const int* height, int n, float* out) const {
    std::size_t k = 0;
    for (int x = 0; x < n; ++x) {
      if (count_ == 0) {
        out[x] = std::numeric_limits<float>::infinity();
        continue;
      }
      while (k + 1 < count_ && from_[k + 1] <= x) ++k;
      const double dx = x - place_[k];
      const double dy = height[place_[k]];
      out[x] = static_cast<float>(std::sqrt(dx * dx + dy * dy));
    }
  }

 private:
  static double crossing(const int* height, int p, int q) {
    const double a = static_cast<double>(height[p]) * height[p] + static_cast<double>(p) * p;
    const double b = static_cast<double>(height[q]) * height[q] + static_cast<double>(q) * q;
    return (b - a) / (2.0 * (q - p));
  }

  std::vector<int> place_;    ///< column of each parabola
  std::vector<double> from_;  ///< where it begins to be the lowest
  std::size_t count_ = 0;
};

struct Spread {
  int column, row;              ///< a cell reached
  int sourceColumn, sourceRow;  ///< and the free cell it was reached from
};

}  // namespace

void checkGrid(const std::filesystem::path& file, double columns, double rows, double cell,
               double originX, double originY) {
  const auto refuse = [&](const std::string& what) { throw MapError(file.string() + ": " + what); };
  if (!(columns >= 1 && rows >= 1 && columns * rows <= static_cast<double>(kMaxGridCells)))
    refuse("the map has " + std::to_string(static_cast<long long>(columns)) + " x " +
           std::to_string(static_cast<long long>(rows)) + " cells, expected 1 to 2^26 in all");
  if (!(cell >= 0.001 && cell <= 100.0))
    refuse("the resolution is " + std::to_string(cell) + " m, expected 0.001 to 100");
  const bool inside = std::abs(originX) <= kFarthest && std::abs(originY) <= kFarthest &&
                      originX + columns * cell <= kFarthest && originY + rows * cell <= kFarthest;
  if (!inside) refuse("the map reaches beyond 10 km from the origin");
}

void markUnknownNearFree(GridMap& map, double margin) {
  const double reach = margin / map.cell;
  std::vector<Spread> front;
  const auto visit = [&](const Spread& from, int column, int row) {
    if (column < 0 || row < 0 || column >= map.columns || row >= map.rows) return;
    GridCell& cell = map.cells[map.index(column, row)];
    const double dx = column - from.sourceColumn;
    const double dy = row - from.sourceRow;
    if (cell != GridCell::unknown || dx * dx + dy * dy > reach * reach) return;
    cell = GridCell::unknownNearFree;
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
      if (map.at(column, row) == GridCell::free) visitNeighbours({column, row, column, row});
  while (!front.empty()) {  // one ring after the other
    std::vector<Spread> ring;
    ring.swap(front);
    for (const Spread& from : ring) visitNeighbours(from);
  }
}

std::vector<float> distanceToOccupied(const GridMap& map) {
  const int far = map.rows + map.columns + 1;
  const std::vector<int> inColumn = distanceInColumn(map, far);
  std::vector<float> distance(map.cells.size());
  Envelope envelope(static_cast<std::size_t>(map.columns));
  for (int row = 0; row < map.rows; ++row) {
    envelope.build(&inColumn[map.index(0, row)], map.columns, far);
    envelope.read(&inColumn[map.index(0, row)], map.columns, &distance[map.index(0, row)]);
  }
  return distance;
}

GridMap readGridMap(const std::filesystem::path& file) {
  const auto endsIn = [name = file.filename().string()](const std::string& end) {
    return name.size() > end.size() && name.ends_with(end);
  };
  if (endsIn(".yaml") || endsIn(".yml")) return readMapServer(file);
  if (endsIn(".gridmap") || endsIn(".gridmap.gz")) return readMrptGridMap(file);
  for (const char* end : {".map", ".cmf", ".carmen", ".map.gz", ".cmf.gz", ".carmen.gz"})
    if (endsIn(end)) return readCarmenMap(file);
  throw MapError(file.string() +
                 ": is no kind of map that can be read, expected a map_server map (.yaml, .yml), "
                 "a CARMEN map (.map, .cmf, .carmen, also with .gz) or an MRPT grid map (.gridmap, "
                 ".gridmap.gz)");
}

}  // namespace ortung

#include "MendedGrid.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>
#include <vector>

namespace ortung::app {
namespace {

/// Distance from a wall that is gone within which cells become free [m]: surfaces of a wall are
/// thin, and were found in cells of 0.1 m.
constexpr double kAround = 0.15;
constexpr double kLargestRest = 9.0;  ///< greatest area of a rest that is looked at [m^2]
constexpr double kMostOpen = 0.5;     ///< share of a rest's border beyond which it is gone, too

constexpr int kThinnings = 2;

/// A cell of the grid, or one beside it.
struct Place {
  long column;
  long row;
};

class Mending {
 public:
  explicit Mending(WorldGrid& grid)
      : grid_(grid), isFreed_(grid.cells.size(), false), isSeen_(grid.cells.size(), false) {}

  void free(double x, double y) {
    const auto reach = static_cast<long>(std::ceil(kAround / grid_.cell));
    const Place middle = placeOf(x, y);
    for (long row = middle.row - reach; row <= middle.row + reach; ++row)
      for (long column = middle.column - reach; column <= middle.column + reach; ++column) {
        const double dx = centreX(column) - x;
        const double dy = centreY(row) - y;
        if (has({column, row}) && std::hypot(dx, dy) <= kAround) freeAt({column, row});
      }
  }

  /// Frees the rests of bodies whose surface is gone.
  void freeRests() {
    for (std::size_t i = 0; i < grid_.cells.size(); ++i)
      if (isFreed_[i]) {
        const Place at{static_cast<long>(i % grid_.columns), static_cast<long>(i / grid_.columns)};
        for (const Place& next : around(at))
          if (isSolid(next) && !isSeen_[indexOf(next)]) freeIfOpen(next);
      }
  }

  void occupy(double x, double y) {
    const Place at = placeOf(x, y);
    if (!has(at) || grid_.cells[indexOf(at)] == WorldGrid::kOccupied) return;
    grid_.cells[indexOf(at)] = WorldGrid::kOccupied;
    ++counts_.occupied;
  }

  const MendedCells& counts() const { return counts_; }

 private:
  Place placeOf(double x, double y) const {
    return {std::lround(std::floor((x - grid_.originX) / grid_.cell)),
            std::lround(std::floor((y - grid_.originY) / grid_.cell))};
  }
  double centreX(long column) const {
    return grid_.originX + (static_cast<double>(column) + 0.5) * grid_.cell;
  }
  double centreY(long row) const {
    return grid_.originY + (static_cast<double>(row) + 0.5) * grid_.cell;
  }
  bool has(const Place& at) const {
    return at.column >= 0 && at.row >= 0 && at.column < static_cast<long>(grid_.columns) &&
           at.row < static_cast<long>(grid_.rows);
  }
  std::size_t indexOf(const Place& at) const {
    return static_cast<std::size_t>(at.row) * grid_.columns + static_cast<std::size_t>(at.column);
  }
  bool isSolid(const Place& at) const {
    return has(at) && grid_.cells[indexOf(at)] != WorldGrid::kFree;
  }
  static std::vector<Place> around(const Place& at) {
    return {{at.column + 1, at.row},
            {at.column - 1, at.row},
            {at.column, at.row + 1},
            {at.column, at.row - 1}};
  }
  void freeAt(const Place& at) {
    const std::size_t i = indexOf(at);
    if (grid_.cells[i] == WorldGrid::kFree) return;
    grid_.cells[i] = WorldGrid::kFree;
    isFreed_[i] = true;
    ++counts_.freed;
  }

  /// Frees the connected solid cells from @p first on if they are few, and most of what is around
  /// them has become free.
  void freeIfOpen(const Place& first) {
    const double most = kLargestRest / (grid_.cell * grid_.cell);
    std::vector<Place> rest{first};
    isSeen_[indexOf(first)] = true;
    std::size_t border = 0;
    std::size_t opened = 0;
    bool isAtEdge = false;
    for (std::size_t k = 0; k < rest.size(); ++k)
      for (const Place& next : around(rest[k])) {
        if (!has(next)) {
          isAtEdge = true;
          continue;
        }
        const std::size_t i = indexOf(next);
        if (grid_.cells[i] == WorldGrid::kFree) {
          ++border;
          if (isFreed_[i]) ++opened;
        } else if (!isSeen_[i]) {
          isSeen_[i] = true;
          rest.push_back(next);
        }
      }
    const bool isSmall = static_cast<double>(rest.size()) <= most;
    if (isAtEdge || !isSmall ||
        static_cast<double>(opened) <= kMostOpen * static_cast<double>(border))
      return;
    for (const Place& at : rest) freeAt(at);
  }

  WorldGrid& grid_;
  std::vector<bool> isFreed_;
  std::vector<bool> isSeen_;
  MendedCells counts_;
};

/// Calls use(other) for the others within a distance [m]. @pre cells are sorted by x
template <class Use>
void forEachNear(const std::vector<ChangesData::Cell>& cells, std::size_t of, double distance,
                 const Use& use) {
  const auto look = [&](std::size_t other) {
    if (std::abs(cells[other].x - cells[of].x) > distance) return false;
    if (std::hypot(cells[other].x - cells[of].x, cells[other].y - cells[of].y) <= distance)
      use(cells[other]);
    return true;
  };
  for (std::size_t other = of; other-- > 0 && look(other);) continue;
  for (std::size_t other = of + 1; other < cells.size() && look(other); ++other) continue;
}

/// Moves each place to the middle of those around it, since noise lets a thin wall end beams in
/// cells beside each other. @returns them sorted by x
std::vector<ChangesData::Cell> thinned(std::vector<ChangesData::Cell> cells, double around) {
  std::sort(cells.begin(), cells.end(), [](const auto& a, const auto& b) { return a.x < b.x; });
  std::vector<ChangesData::Cell> middles = cells;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    double count = 1.0;
    forEachNear(cells, i, around, [&](const ChangesData::Cell& other) {
      count += 1.0;
      middles[i].x += (other.x - middles[i].x) / count;
      middles[i].y += (other.y - middles[i].y) / count;
    });
  }
  std::sort(middles.begin(), middles.end(), [](const auto& a, const auto& b) { return a.x < b.x; });
  return middles;
}

/// Occupies the line between two places that were found next to each other.
void join(const ChangesData::Cell& from, const ChangesData::Cell& to, double step,
          Mending& mending) {
  const double way = std::hypot(to.x - from.x, to.y - from.y);
  const auto steps = static_cast<int>(std::ceil(way / step));
  for (int k = 0; k <= steps; ++k) {
    const double share = steps == 0 ? 0.0 : static_cast<double>(k) / steps;
    mending.occupy(from.x + share * (to.x - from.x), from.y + share * (to.y - from.y));
  }
}

}  // namespace

MendedCells mend(const ChangesData::Reading& changes, WorldGrid& grid) {
  constexpr double kNeighbours = 1.5;  // [cells]
  Mending mending(grid);
  std::vector<ChangesData::Cell> fresh;
  std::set<std::pair<double, double>> taken;  // one of each cell, whoever wrote the file
  for (const ChangesData::Cell& one : changes.cells) {
    if (!one.isSure) continue;
    const std::pair place(std::floor(one.x / changes.cell), std::floor(one.y / changes.cell));
    if (one.isNew) {
      if (taken.insert(place).second) fresh.push_back(one);
    } else
      mending.free(one.x, one.y);
  }
  mending.freeRests();
  const double near = kNeighbours * changes.cell;
  for (int k = 0; k < kThinnings; ++k) fresh = thinned(std::move(fresh), near);
  for (std::size_t i = 0; i < fresh.size(); ++i) {
    mending.occupy(fresh[i].x, fresh[i].y);
    forEachNear(fresh, i, near, [&](const ChangesData::Cell& other) {
      join(fresh[i], other, 0.5 * grid.cell, mending);
    });
  }
  return mending.counts();
}

}  // namespace ortung::app

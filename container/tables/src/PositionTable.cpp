#include "ortung/tables/PositionTable.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "ortung/base/Angles.hpp"

namespace ortung {
namespace {

constexpr int kDirections = 65535;  // levels 0..65534, so that CellTable::kNone stays free
constexpr double kPerRadian = kDirections / kTurn;

/// Along one axis of the grid: the cell before a place, and the place's distance from its centre.
struct Between {
  std::size_t before;
  double share;

  /// @param place in cells, from the centre of the first one
  Between(double place, int cells)
      : before(static_cast<std::size_t>(std::clamp(place, 0.0, std::max(0.0, cells - 2.0)))),
        share(std::clamp(place - static_cast<double>(before), 0.0, cells > 1 ? 1.0 : 0.0)) {}
};

/// Returns the shorter difference between two levels.
double way(double to, double from, int turn) {
  const double levels = to - from;
  if (turn == 0) return levels;
  return levels - turn * std::nearbyint(levels / turn);
}

/// Returns the level at a point, interpolated between the centres of the four cells around it; if
/// one of the four is empty, that of the point's own cell, and NaN if that is empty. @param turn
/// number of levels of a full turn (directions), or 0
double between(const CellTable& table, double x, double y, int turn) {
  const std::uint16_t own = table.at(x, y);
  if (own == CellTable::kNone) return std::numeric_limits<double>::quiet_NaN();
  const FieldGrid& grid = table.grid();
  const Between column((x - grid.originX) / grid.cell - 0.5, grid.columns);
  const Between row((y - grid.originY) / grid.cell - 0.5, grid.rows);
  const auto columns = static_cast<std::size_t>(grid.columns);
  const std::size_t right = grid.columns > 1 ? 1 : 0;
  const std::size_t up = grid.rows > 1 ? columns : 0;
  const std::uint16_t* cell = table.levels().data() + row.before * columns + column.before;
  const std::array<std::uint16_t, 4> level = {cell[0], cell[right], cell[up], cell[up + right]};
  if (*std::max_element(level.begin(), level.end()) == CellTable::kNone) return own;
  const double first = level[0];
  const double lower = column.share * way(level[1], first, turn);
  const double above = way(level[2], first, turn);
  const double upper = above + column.share * (way(level[3], first, turn) - above);
  return first + lower + row.share * (upper - lower);
}

}  // namespace

void CellTable::start(const FieldGrid& grid) {
  grid_ = grid;
  own_.assign(grid.size(), kNone);
  levels_ = own_;
}

void CellTable::set(double x, double y, std::uint16_t level) {
  const std::ptrdiff_t cell = grid_.cellAt(x, y);
  if (cell >= 0 && !own_.empty()) own_[static_cast<std::size_t>(cell)] = level;
}

void CellTable::save(TableWriter& file, const std::string& name) const {
  file.add<std::uint16_t>(
      name, {static_cast<std::size_t>(grid_.rows), static_cast<std::size_t>(grid_.columns)},
      levels_);
}

void CellTable::load(const std::shared_ptr<const TableFile>& file, const std::string& name,
                     const FieldGrid& grid) {
  levels_ = file->get<std::uint16_t>(
      name, {static_cast<std::size_t>(grid.rows), static_cast<std::size_t>(grid.columns)});
  grid_ = grid;
  file_ = file;
  own_.clear();
}

PositionTable::PositionTable(double maxRange)
    : metresPerLevel_(std::max(0.001, maxRange / (CellTable::kNone - 1))) {}

void PositionTable::learn(double x, double y, double range) {
  const double level = std::nearbyint(range / metresPerLevel_);
  if (level >= 0 && level < CellTable::kNone) cells_.set(x, y, static_cast<std::uint16_t>(level));
}

float PositionTable::at(double x, double y) const {
  return static_cast<float>(between(cells_, x, y, 0) * metresPerLevel_);
}

void BearingTable::learn(double x, double y, double directionInField) {
  const int level =
      static_cast<int>(std::lround(std::remainder(directionInField, kTurn) * kPerRadian));
  cells_.set(x, y, static_cast<std::uint16_t>((level + kDirections) % kDirections));
}

float BearingTable::at(double x, double y) const {
  return static_cast<float>(std::remainder(between(cells_, x, y, kDirections) / kPerRadian, kTurn));
}

}  // namespace ortung

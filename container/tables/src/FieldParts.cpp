#include "ortung/tables/FieldParts.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

namespace ortung {
namespace {

/// An enclosed part counts if this many times its cells are at least those of the largest part.
constexpr std::size_t kEnclosedCounts = 4;

bool isAtEdge(const FieldGrid& grid, std::size_t cell) {
  const auto columns = static_cast<std::size_t>(grid.columns);
  const std::size_t column = cell % columns;
  return column == 0 || column + 1 == columns || cell < columns || cell + columns >= grid.size();
}

template <class Visit>
void forEachNeighbour(const FieldGrid& grid, std::size_t cell, const Visit& visit) {
  const auto columns = static_cast<std::size_t>(grid.columns);
  const std::size_t column = cell % columns;
  if (column > 0) visit(cell - 1);
  if (column + 1 < columns) visit(cell + 1);
  if (cell >= columns) visit(cell - columns);
  if (cell + columns < grid.size()) visit(cell + columns);
}

}  // namespace

FieldParts::FieldParts(FieldRegion region, const std::vector<std::uint8_t>& passable)
    : region_(std::move(region)), partOf_(region_.grid.size(), kNone) {
  if (passable.size() != region_.grid.size() || region_.standable.size() != passable.size())
    throw std::invalid_argument("field parts: a mask of " + std::to_string(passable.size()) +
                                " cells, expected " + std::to_string(region_.grid.size()));
  std::vector<std::size_t> next;  // cells whose neighbours are still to be visited
  for (std::size_t start = 0; start < passable.size(); ++start) {
    if (passable[start] == 0 || partOf_[start] != kNone) continue;
    const auto number = static_cast<std::uint32_t>(parts_.size());
    parts_.emplace_back();
    next.assign(1, start);
    partOf_[start] = number;
    while (!next.empty()) {
      const std::size_t cell = next.back();
      next.pop_back();
      parts_[number].cells += region_.standable[cell] != 0 ? 1 : 0;
      parts_[number].reachesEdge = parts_[number].reachesEdge || isAtEdge(region_.grid, cell);
      forEachNeighbour(region_.grid, cell, [&](std::size_t other) {
        if (passable[other] == 0 || partOf_[other] != kNone) return;
        partOf_[other] = number;
        next.push_back(other);
      });
    }
  }
}

std::optional<std::size_t> FieldParts::partAt(double x, double y) const {
  const std::ptrdiff_t cell = region_.grid.cellAt(x, y);
  if (cell < 0 || partOf_[static_cast<std::size_t>(cell)] == kNone) return std::nullopt;
  return partOf_[static_cast<std::size_t>(cell)];
}

std::size_t FieldParts::main(bool edgeIsOutside) const {
  const auto smaller = [](const Part& a, const Part& b) { return a.cells < b.cells; };
  const auto largest = std::max_element(parts_.begin(), parts_.end(), smaller);
  const auto enclosed =
      std::max_element(parts_.begin(), parts_.end(), [&](const Part& a, const Part& b) {
        return a.reachesEdge != b.reachesEdge ? a.reachesEdge : smaller(a, b);
      });
  const bool isInside = edgeIsOutside && largest->reachesEdge && !enclosed->reachesEdge &&
                        kEnclosedCounts * enclosed->cells >= largest->cells;
  return static_cast<std::size_t>((isInside ? enclosed : largest) - parts_.begin());
}

FieldRegion FieldParts::only(std::size_t part) const {
  FieldRegion region = region_;
  for (std::size_t cell = 0; cell < partOf_.size(); ++cell)
    if (partOf_[cell] != part) region.standable[cell] = 0;
  return region;
}

bool canStandNear(const FieldRegion& region, double x, double y, double radius) {
  if (!std::isfinite(x) || !std::isfinite(y) || !(radius >= 0.0)) return false;
  const FieldGrid& grid = region.grid;
  const auto clamped = [](double place, int n) {
    return static_cast<int>(std::clamp(std::floor(place), 0.0, static_cast<double>(n)));
  };
  const int firstColumn = clamped((x - radius - grid.originX) / grid.cell - 1.0, grid.columns);
  const int lastColumn = clamped((x + radius - grid.originX) / grid.cell + 1.0, grid.columns - 1);
  const int firstRow = clamped((y - radius - grid.originY) / grid.cell - 1.0, grid.rows);
  const int lastRow = clamped((y + radius - grid.originY) / grid.cell + 1.0, grid.rows - 1);
  for (int row = firstRow; row <= lastRow; ++row) {
    for (int column = firstColumn; column <= lastColumn; ++column) {
      const auto cell = static_cast<std::size_t>(row) * static_cast<std::size_t>(grid.columns) +
                        static_cast<std::size_t>(column);
      if (region.standable[cell] != 0 &&
          std::hypot(grid.centreX(cell) - x, grid.centreY(cell) - y) <= radius)
        return true;
    }
  }
  return false;
}

}  // namespace ortung

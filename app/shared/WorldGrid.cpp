#include "WorldGrid.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numbers>

#include "Console.hpp"
#include "Interrupt.hpp"

namespace ortung::app {
namespace {

WorldGrid gridOver(const Box2& bounds, double cell) {
  constexpr double kMostCells = 1U << 26;
  constexpr double kMargin = 2.0;  // [cells], so that walls at the edge are included
  const double left = std::floor(bounds.xLow / cell - kMargin);
  const double bottom = std::floor(bounds.yLow / cell - kMargin);
  const double columns = std::ceil(bounds.xHigh / cell + kMargin) - left;
  const double rows = std::ceil(bounds.yHigh / cell + kMargin) - bottom;
  if (!(columns * rows <= kMostCells))
    throw UsageError(fmt::format("--cell {} makes a map of {} x {} cells, expected at most {}",
                                 cell, columns, rows, kMostCells));
  WorldGrid grid{cell,
                 left * cell,
                 bottom * cell,
                 static_cast<std::size_t>(columns),
                 static_cast<std::size_t>(rows),
                 ""};
  grid.cells.assign(grid.columns * grid.rows, WorldGrid::kUnknown);
  return grid;
}

/// Marks the surfaces that are seen from a cell, up to the adjacent cells.
void lookAround(const SimWorld& world, double height, double x, double y, WorldGrid& grid) {
  constexpr std::size_t kRays = 16;
  constexpr double kBehind = 1e-4;  // distance behind the surface [m]
  constexpr double kFirst = 0.1;    // first direction; no ray from a centre hits a corner [rad]
  const double far = 2.0 * grid.cell;
  std::array<float, kRays> ranges{};
  const double step = 2.0 * std::numbers::pi / kRays;
  world.castFan(
      {.x = x, .y = y, .z = height, .firstAngle = kFirst, .angleStep = step, .maxRange = far}, 0,
      ranges);
  for (std::size_t i = 0; i < kRays; ++i) {
    const double range = static_cast<double>(ranges[i]) + kBehind;
    if (range >= far) continue;
    const double angle = kFirst + step * static_cast<double>(i);
    const double column = std::floor((x + range * std::cos(angle) - grid.originX) / grid.cell);
    const double row = std::floor((y + range * std::sin(angle) - grid.originY) / grid.cell);
    if (column < 0 || row < 0 || column >= static_cast<double>(grid.columns) ||
        row >= static_cast<double>(grid.rows))
      continue;
    grid.cells[static_cast<std::size_t>(row) * grid.columns + static_cast<std::size_t>(column)] =
        WorldGrid::kOccupied;
  }
}

}  // namespace

WorldGrid drawGrid(const SimWorld& world, double cell, double height) {
  WorldGrid grid = gridOver(world.solids().bounds, cell);
  constexpr double kPoint = 0.001;  // radius of the scanner [m]
  const RobotSize scanner{kPoint, std::max(height, kPoint)};
  for (std::size_t row = 0; row < grid.rows; ++row) {
    checkInterrupt();
    for (std::size_t column = 0; column < grid.columns; ++column) {
      const double x = grid.originX + (static_cast<double>(column) + 0.5) * cell;
      const double y = grid.originY + (static_cast<double>(row) + 0.5) * cell;
      if (!world.isFree(x, y, scanner)) continue;
      char& one = grid.cells[row * grid.columns + column];
      if (one == WorldGrid::kUnknown) one = WorldGrid::kFree;
      lookAround(world, height, x, y, grid);
    }
  }
  return grid;
}

}  // namespace ortung::app

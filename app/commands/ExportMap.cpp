#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

#include "Commands.hpp"
#include "Console.hpp"
#include "Interrupt.hpp"
#include "Outputs.hpp"
#include "Workshop.hpp"
#include "ortung/base/HelperProgram.hpp"
#include "ortung/sim/SimWorld.hpp"

namespace ortung::app {
namespace {

namespace fs = std::filesystem;

constexpr char kOccupied = 0;
constexpr char kUnknown = static_cast<char>(205);
constexpr char kFree = static_cast<char>(254);

/// Cells as a map of map_server has them, the bottom row first.
struct Grid {
  double cell = 0.0;     ///< edge [m]
  double originX = 0.0;  ///< of cell (0, 0), its lower left corner [m]; a multiple of the edge
  double originY = 0.0;
  std::size_t columns = 0;
  std::size_t rows = 0;
  std::string cells;
};

Grid gridOver(const Box2& bounds, double cell) {
  constexpr double kMostCells = 1U << 26;
  constexpr double kMargin = 2.0;  // [cells], so that walls at the edge are in it
  const double left = std::floor(bounds.xLow / cell - kMargin);
  const double bottom = std::floor(bounds.yLow / cell - kMargin);
  const double columns = std::ceil(bounds.xHigh / cell + kMargin) - left;
  const double rows = std::ceil(bounds.yHigh / cell + kMargin) - bottom;
  if (!(columns * rows <= kMostCells))
    throw UsageError(fmt::format("--cell {} makes a map of {} x {} cells, expected at most {}",
                                 cell, columns, rows, kMostCells));
  Grid grid{cell,
            left * cell,
            bottom * cell,
            static_cast<std::size_t>(columns),
            static_cast<std::size_t>(rows),
            ""};
  grid.cells.assign(grid.columns * grid.rows, kUnknown);
  return grid;
}

/// Marks the surfaces that are seen from a cell, as near as the next cells.
void lookAround(const SimWorld& world, double height, double x, double y, Grid& grid) {
  constexpr std::size_t kRays = 16;
  constexpr double kBehind = 1e-4;  // the surface [m]
  constexpr double kFirst = 0.1;    // so that no ray leads from a centre to a corner [rad]
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
        kOccupied;
  }
}

/// What a scanner sees at that height: surfaces are occupied, what is free is free, and what it
/// can't look into (or over) is not known.
Grid draw(const SimWorld& world, double cell, double height) {
  Grid grid = gridOver(world.solids().bounds, cell);
  constexpr double kPoint = 0.001;  // [m]
  const RobotSize scanner{kPoint, std::max(height, kPoint)};
  for (std::size_t row = 0; row < grid.rows; ++row) {
    checkInterrupt();
    for (std::size_t column = 0; column < grid.columns; ++column) {
      const double x = grid.originX + (static_cast<double>(column) + 0.5) * cell;
      const double y = grid.originY + (static_cast<double>(row) + 0.5) * cell;
      if (!world.isFree(x, y, scanner)) continue;
      char& one = grid.cells[row * grid.columns + column];
      if (one == kUnknown) one = kFree;
      lookAround(world, height, x, y, grid);
    }
  }
  return grid;
}

/// A grey picture (PGM) with the top row first.
std::string pictureOf(const Grid& grid) {
  std::string text = fmt::format("P5\n{} {}\n255\n", grid.columns, grid.rows);
  for (std::size_t row = grid.rows; row-- > 0;)
    text.append(grid.cells, row * grid.columns, grid.columns);
  return text;
}

void writeMapServer(const Grid& grid, const Workshop& workshop) {
  const fs::path picture = workshop.file().filename().replace_extension(".pgm");
  writeFile(workshop.folder() / picture, pictureOf(grid));
  writeFile(workshop.file(),
            fmt::format("image: {}\nresolution: {}\norigin: [{}, {}, 0]\nnegate: 0\n"
                        "occupied_thresh: 0.65\nfree_thresh: 0.196\n",
                        picture.string(), grid.cell, grid.originX, grid.originY));
}

void writeGridMap(Grid grid, const Workshop& workshop) {
  constexpr std::size_t kMostSaid = 1U << 16;
  const Workshop text("--out", "grid.txt");
  for (char& one : grid.cells) {  // MRPT: how free it is
    if (one == kUnknown) one = static_cast<char>(127);
    if (one == kFree) one = static_cast<char>(255);
  }
  writeFile(text.file(), fmt::format("ortung-gridmap {} {} {} {} {}\n", grid.columns, grid.rows,
                                     grid.cell, grid.originX, grid.originY) +
                             grid.cells);
  runHelper(findHelper("ortung-mrpt-writer", workshop.file().string()),
            {"gridmap", text.file().string(), workshop.file().string()}, workshop.file().string(),
            kMostSaid);
}

}  // namespace

int runExportMap(const ExportMapArguments& arguments) {
  const bool isYaml = arguments.out.extension() == ".yaml";
  if (!isYaml && arguments.out.extension() != ".gridmap")
    throw UsageError("--out is '" + arguments.out.string() +
                     "', expected NAME.yaml or NAME.gridmap");
  Outputs outputs(arguments.force);
  outputs.reads(arguments.world);
  outputs.writes("--out", arguments.out, isYaml ? OutputKind::kSettings : OutputKind::kRawlog);
  Workshop workshop("--out", arguments.out);
  const Grid grid = draw(*readWorld(arguments.world), arguments.cell, arguments.height);
  isYaml ? writeMapServer(grid, workshop) : writeGridMap(grid, workshop);
  workshop.declare(outputs);
  workshop.deliver(outputs);
  fmt::print("{}: {} x {} cells of {:g} m\n", printable(arguments.out.string()), grid.columns,
             grid.rows, arguments.cell);
  return 0;
}

}  // namespace ortung::app

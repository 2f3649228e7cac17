#include "ExportMap.hpp"

#include <fmt/format.h>

#include <stdexcept>
#include <string>

#include "Console.hpp"
#include "Outputs.hpp"
#include "Workshop.hpp"
#include "WorldGrid.hpp"
#include "ortung/base/HelperProgram.hpp"
#include "ortung/sim/SimWorld.hpp"

namespace ortung::app {
namespace {

namespace fs = std::filesystem;

/// A grey picture (PGM) with the top row first.
std::string pictureOf(const WorldGrid& grid) {
  std::string text = fmt::format("P5\n{} {}\n255\n", grid.columns, grid.rows);
  for (std::size_t row = grid.rows; row-- > 0;)
    text.append(grid.cells, row * grid.columns, grid.columns);
  return text;
}

void writeMapServer(const WorldGrid& grid, const Workshop& workshop) {
  const fs::path picture = workshop.file().filename().replace_extension(".pgm");
  writeFile(workshop.folder() / picture, pictureOf(grid));
  writeFile(workshop.file(),
            fmt::format("image: {}\nresolution: {}\norigin: [{}, {}, 0]\nnegate: 0\n"
                        "occupied_thresh: 0.65\nfree_thresh: 0.196\n",
                        picture.string(), grid.cell, grid.originX, grid.originY));
}

void writeGridMap(WorldGrid grid, const Workshop& workshop) {
  constexpr std::size_t kMostSaid = 1U << 16;
  const Workshop text("--out", "grid.txt");
  for (char& one : grid.cells) {  // MRPT: how free it is
    if (one == WorldGrid::kUnknown) one = static_cast<char>(127);
    if (one == WorldGrid::kFree) one = static_cast<char>(255);
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
  const WorldGrid grid = drawGrid(*readWorld(arguments.world), arguments.cell, arguments.height);
  isYaml ? writeMapServer(grid, workshop) : writeGridMap(grid, workshop);
  workshop.declare(outputs);
  workshop.deliver(outputs);
  fmt::print("{}: {} x {} cells of {:g} m\n", printable(arguments.out.string()), grid.columns,
             grid.rows, arguments.cell);
  return 0;
}

}  // namespace ortung::app

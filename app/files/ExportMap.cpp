#include "ExportMap.hpp"

#include <fmt/format.h>

#include <stdexcept>
#include <string>

#include "Console.hpp"
#include "MapServerFile.hpp"
#include "Outputs.hpp"
#include "Workshop.hpp"
#include "WorldGrid.hpp"
#include "ortung/base/HelperProgram.hpp"
#include "ortung/sim/SimWorld.hpp"

namespace ortung::app {
namespace {

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
  isYaml ? writeMapServer(grid, workshop.file()) : writeGridMap(grid, workshop);
  workshop.declare(outputs);
  workshop.deliver(outputs);
  fmt::print("{}: {} x {} cells of {:g} m\n", printable(arguments.out.string()), grid.columns,
             grid.rows, arguments.cell);
  return 0;
}

}  // namespace ortung::app

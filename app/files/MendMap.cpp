#include "MendMap.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <string>

#include "Console.hpp"
#include "MapServerFile.hpp"
#include "MendedGrid.hpp"
#include "MendedPicture.hpp"
#include "MendedWorld.hpp"
#include "Outputs.hpp"
#include "Workshop.hpp"
#include "WorldGrid.hpp"
#include "ortung/run/FoundChanges.hpp"
#include "ortung/sim/SimWorld.hpp"

namespace ortung::app {
namespace {

namespace fs = std::filesystem;

/// @throws std::runtime_error if they are of another world, or none is sure
ChangesData::Reading changesOf(const MendMapArguments& arguments, const SimWorld& world) {
  const FoundChanges found = readFoundChanges(arguments.changes);
  if (!found.worldFingerprint.empty() && found.worldFingerprint != world.fingerprint())
    throw std::runtime_error(fmt::format("{}: is about the world {}, but {} is {}",
                                         arguments.changes.string(), found.worldFingerprint,
                                         arguments.world.string(), world.fingerprint()));
  const auto& cells = found.changes.cells;
  if (std::none_of(cells.begin(), cells.end(), [](const auto& one) { return one.isSure; }))
    throw std::runtime_error(fmt::format(
        "{}: nothing is sure to have changed ({} cells were found otherwise, expected some next to "
        "each other in two passes of the robot)",
        arguments.changes.string(), cells.size()));
  return found.changes;
}

}  // namespace

int runMendMap(const MendMapArguments& arguments) {
  if (arguments.out.extension() != ".toml")
    throw UsageError("--out is '" + arguments.out.string() + "', expected NAME.toml");
  Outputs outputs(arguments.force);
  outputs.reads(arguments.world);
  outputs.reads(arguments.changes);
  outputs.writes("--out", arguments.out, OutputKind::kSettings);
  outputs.writes("--picture", arguments.picture, OutputKind::kPicture);
  Workshop workshop("--out", arguments.out);
  const auto world = readWorld(arguments.world);
  const ChangesData::Reading changes = changesOf(arguments, *world);
  const WorldGrid before = drawGrid(*world, arguments.cell, arguments.height);
  WorldGrid after = before;
  const MendedCells counts = mend(changes, after);
  fs::path map = workshop.file();
  map.replace_extension(".yaml");
  writeMapServer(after, map);
  writeFile(workshop.file(), mendedWorld(arguments.world, *world, map.filename().string()));
  readWorld(workshop.file());  // a proposal that can't be read is none
  workshop.declare(outputs);
  if (!arguments.picture.empty())
    outputs.write(arguments.picture, drawMended(before, changes, after).png());
  workshop.deliver(outputs);
  fmt::print("{}: {} cells of {:g} m became free, {} occupied\n", printable(arguments.out.string()),
             counts.freed, arguments.cell, counts.occupied);
  return 0;
}

}  // namespace ortung::app

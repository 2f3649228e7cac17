// Tables that a robot learns in a world.
#include <pybind11/stl/filesystem.h>

#include <algorithm>
#include <filesystem>
#include <string>

#include "OwnFiles.hpp"
#include "Progress.hpp"
#include "Worlds.hpp"
#include "ortung/robot/RobotFile.hpp"
#include "ortung/sim/TableLearner.hpp"

namespace ortung::python {
namespace {

std::size_t countOf(const std::vector<std::uint8_t>& mask) {
  return static_cast<std::size_t>(std::count(mask.begin(), mask.end(), std::uint8_t{1}));
}

py::dict summaryOf(TableLearner& tables, std::uintmax_t bytes) {
  py::dict headings;
  for (const Learner::Need& need : tables.learner().needs())
    headings[py::str(toText(need.feature))] = need.headings;
  const FieldRegion& region = tables.region();
  py::dict summary;
  summary["world"] = tables.world().name();
  summary["robot"] = tables.robot().name;
  summary["headings"] = headings;
  summary["columns"] = region.grid.columns;
  summary["rows"] = region.grid.rows;
  summary["open"] = countOf(region.open);
  summary["standable"] = countOf(region.standable);
  summary["left_out_m2"] = tables.leftOut();
  summary["bytes"] = bytes;
  return summary;
}

py::dict learnTables(const py::object& world, const std::filesystem::path& robot,
                     const std::filesystem::path& out, double cell, double headingStep,
                     const std::string& area, unsigned threads, const py::object& progress,
                     bool force) {
  refuseOther(out, FileKind::kTables, force);
  const SharedWorld shared = worldOf(world);
  std::string part = area;  // "x,y" of the command line
  std::replace(part.begin(), part.end(), ',', ';');
  ProgressTeller teller(progress);
  std::unique_ptr<TableLearner> tables;
  std::uintmax_t bytes = 0;
  {
    const py::gil_scoped_release others;
    tables =
        std::make_unique<TableLearner>(shared.world->another(), readRobot(robot),
                                       TableLearner::Settings{cell, headingStep, part, threads});
    bool goesOn = true;
    while (goesOn && tables->learner().step()) goesOn = teller.tell(tables->learner().share());
    if (goesOn) bytes = tables->write(out);
  }
  teller.raiseIfStopped();
  return summaryOf(*tables, bytes);
}

}  // namespace

void bindLearner(py::module_& module) {
  module.def(
      "learn", &learnTables, py::arg("world"), py::arg("robot"), py::arg("out"),
      py::arg("cell") = 0.1, py::arg("heading_step_deg") = 2.0, py::arg("area") = "auto",
      py::arg("threads") = 1, py::arg("progress") = py::none(), py::arg("force") = false,
      "Learns what a robot's sensors read everywhere in a world, as `ortung learn` does, and "
      "writes the tables to `out`, which may be there if it has tables (force: whatever it has). "
      "world: a World, or the file of one; robot: its file; cell: edge "
      "of a cell [m]; heading_step_deg: divides a turn; area: the part of the floor, 'auto', 'all' "
      "or 'x,y' [m]. The tables do not depend on the number of threads. progress(share) is called "
      "now and then with what is done, in [0, 1]; what it raises ends the work, and nothing is "
      "written. Returns what was learned: columns, rows, open and standable cells, the number of "
      "headings of each feature, the area that was left out, bytes of the file.");
}

}  // namespace ortung::python

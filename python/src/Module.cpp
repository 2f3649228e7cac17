#include "Bindings.hpp"
#include "PlainArguments.hpp"
#include "ortung/base/Parameters.hpp"
#include "ortung/core/PluginFactory.hpp"
#include "ortung/run/Localization.hpp"
#include "ortung/tables/TableFile.hpp"

// What only this package imports; people import `ortung`. It needs no simulator:
// LearningModule.cpp.
PYBIND11_MODULE(_core, module) {
  namespace py = pybind11;
  // Messages name file and line; a kind of their own tells what is wrong.
  py::register_exception<ortung::PluginError>(module, "PluginError", PyExc_RuntimeError).doc() =
      "A plugin is missing, broken or built for another version.";
  py::register_exception<ortung::TableError>(module, "TableError", PyExc_RuntimeError).doc() =
      "A table file is torn, or is of another robot.";
  py::register_exception<ortung::ConfigError>(module, "ConfigError", PyExc_ValueError).doc() =
      "A robot, world or other file says what can't be; the message names file, line and key.";
  py::register_exception<ortung::WorldMismatch>(module, "WorldMismatch", PyExc_RuntimeError).doc() =
      "Readings come from another world than the one that tables were learned in.";
  module.attr("__version__") = ORTUNG_VERSION;
  ortung::python::bindContainer(module);
  ortung::python::bindRobots(module);
  ortung::python::bindLocalization(module);
  ortung::python::bindRecords(module);
  ortung::python::bindEvaluation(module);
  ortung::python::speakPlainly(module);
}

#include "Bindings.hpp"
#include "ortung/base/Parameters.hpp"
#include "ortung/core/PluginFactory.hpp"
#include "ortung/run/Localization.hpp"
#include "ortung/tables/TableFile.hpp"

// What only this package imports; people import `ortung`. It needs no simulator:
// LearningModule.cpp.
PYBIND11_MODULE(_core, module) {
  namespace py = pybind11;
  // Messages name file and line; a kind of their own tells what is wrong.
  py::register_exception<ortung::PluginError>(module, "PluginError", PyExc_RuntimeError);
  py::register_exception<ortung::TableError>(module, "TableError", PyExc_RuntimeError);
  py::register_exception<ortung::ConfigError>(module, "ConfigError", PyExc_ValueError);
  py::register_exception<ortung::WorldMismatch>(module, "WorldMismatch", PyExc_RuntimeError);
  module.attr("__version__") = ORTUNG_VERSION;
  ortung::python::bindContainer(module);
  ortung::python::bindRobots(module);
  ortung::python::bindLocalization(module);
}

#include "Bindings.hpp"
#include "PlainArguments.hpp"

// Worlds and simulations, which need the libraries of the simulator; people import `ortung`.
PYBIND11_MODULE(_sim, module) {
  ortung::python::py::module_::import("ortung._core");  // has the types that both share
  ortung::python::bindWorlds(module);
  ortung::python::bindLearner(module);
  ortung::python::bindSimulations(module);
  ortung::python::speakPlainly(module);
}

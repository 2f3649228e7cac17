#include "Bindings.hpp"
#include "PlainArguments.hpp"

// Environments, apart from the rest of the package since they need the simulator and with it Embree
// and Box2D: loaded when somebody asks for the first one. Exceptions are those of _core.
PYBIND11_MODULE(_learning, module) {
  ortung::python::bindLearning(module);
  ortung::python::speakPlainly(module);
}

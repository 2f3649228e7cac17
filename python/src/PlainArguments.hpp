#pragma once

#include "Bindings.hpp"

namespace ortung::python {

/// Lets all functions and classes of a module say in a sentence which argument they do not take.
/// It is called once all of them are bound.
void speakPlainly(const py::module_& module);

}  // namespace ortung::python

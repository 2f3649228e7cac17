#pragma once

#include "Bindings.hpp"
#include "ortung/run/Localization.hpp"

namespace ortung::python {

/// Reads 'global', 'truth' or (x, y, theta). @throws py::value_error
LocalizationStart startOf(const py::object& start);

}  // namespace ortung::python

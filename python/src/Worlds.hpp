#pragma once

#include <filesystem>
#include <memory>

#include "Bindings.hpp"
#include "ortung/sim/SimWorld.hpp"

namespace ortung::python {

/// A world that was read. It does not change, so all threads may look at it.
struct SharedWorld {
  std::filesystem::path file;
  std::shared_ptr<const SimWorld> world;
};

/// The world of a path, or of a World of Python. @throws ConfigError, py::type_error
SharedWorld worldOf(const py::object& world);

}  // namespace ortung::python

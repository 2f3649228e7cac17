#pragma once

#include <memory>

#include "ortung/core/SensorContainer.hpp"
#include "ortung/run/Robot.hpp"

namespace ortung::python {

/// A container, and what it lives in.
struct Container {
  std::shared_ptr<const void> owner;
  SensorContainer* container = nullptr;
};

}  // namespace ortung::python

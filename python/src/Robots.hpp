#pragma once

#include <memory>

#include "Gate.hpp"
#include "ortung/core/SensorContainer.hpp"
#include "ortung/run/Robot.hpp"

namespace ortung::python {

/// A container, and what it lives in.
struct Container {
  std::shared_ptr<const void> owner;
  SensorContainer* container = nullptr;
  /// Readings come and go together; features are added and learn alone.
  std::shared_ptr<Gate> gate;
};

/// The gate of a container.
inline std::shared_ptr<Gate> containerGate() {
  return std::make_shared<Gate>("this SensorContainer");
}

}  // namespace ortung::python

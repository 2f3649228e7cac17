#pragma once

#include <string>

#include "ortung/base/Export.hpp"
#include "ortung/base/Parameters.hpp"
#include "ortung/base/Time.hpp"
#include "ortung/sim/Scene.hpp"
#include "ortung/sim/Simulation.hpp"

namespace ortung {

/// A simulated run as a source's text names it, "sim:FILE?key=value": a scene, or one robot alone
/// in a world.
struct SimulatedRun {
  Scene scene;
  Simulation::Config config;
  Timestamp duration = 0;    ///< of the last readings
  std::string robot;         ///< whose readings are meant; "": of the simulation's first
  bool hasPictures = false;  ///< whether somebody reads what sensors sense on demand

  /// @param options "path" and "robot_file", and what stands behind the "?" @throws ConfigError
  ORTUNG_API static SimulatedRun read(const Parameters& options);
};

}  // namespace ortung

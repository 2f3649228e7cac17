#pragma once

#include <string>

#include "ortung/base/Export.hpp"
#include "ortung/base/Parameters.hpp"
#include "ortung/base/Time.hpp"
#include "ortung/sim/Scene.hpp"
#include "ortung/sim/Simulation.hpp"

namespace ortung {

/// A simulated run as the source "sim:FILE?key=value" describes it: a scene, or one robot alone in
/// a world.
struct SimulatedRun {
  Scene scene;
  Simulation::Config config;
  Timestamp duration = 0;    ///< time of the last readings [us]
  std::string robot;         ///< the robot whose readings are wanted; "": the first one
  bool hasPictures = false;  ///< whether readings of sensors on demand are wanted

  /// Reads the description. @param options "path" and "robot_file", and the keys behind the "?"
  /// @throws ConfigError
  ORTUNG_API static SimulatedRun read(const Parameters& options);
};

}  // namespace ortung

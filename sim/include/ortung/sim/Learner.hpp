#pragma once

#include <functional>
#include <stdexcept>

#include "ortung/base/Export.hpp"
#include "ortung/robot/RobotFile.hpp"
#include "ortung/sim/SimWorld.hpp"
#include "ortung/sim_api/Sensor.hpp"

namespace ortung {

struct LearnOptions {
  double cell = 0.1;                  ///< edge of a cell [m]
  double headingStep = 0.0349065850;  ///< [rad], 2 degrees; must divide a turn
};

/// Learning was interrupted by its caller.
class ORTUNG_API LearnCancelled : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
  ~LearnCancelled() override;
};

/// The model learner (paper, section 5.2): puts each sensor on the centre of every open cell, in as
/// many headings as it needs, generates noise-free data and calls learnProbability. Features that
/// are made of others learn what is made of those there.
/// @param progress called now and then with the share done, in [0, 1]; returns false to stop
/// @throws LearnCancelled
ORTUNG_API void learn(const SimWorld& world, const FieldRegion& region,
                      const std::vector<Device>& devices, PluginFactory& factory,
                      const LearnOptions& options, const std::function<bool(double)>& progress);

}  // namespace ortung

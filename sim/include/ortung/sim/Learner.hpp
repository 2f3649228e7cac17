#pragma once

#include <array>
#include <functional>
#include <optional>
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

/// What of a world is learned.
struct LearnArea {
  FieldRegion region;    ///< standable in one part of the floor alone: where the robot is
  double leftOut = 0.0;  ///< floor of other parts, on which it could stand, too [m^2]
};
/// Closed rooms, and what walls leave over of their bounding box, are not where a robot is: their
/// poses would be tried and believed.
/// @param inside a point of the part that is wanted; nothing: FieldParts::main() says which
/// @throws std::invalid_argument as SimWorld::region(); if there is no room at @p inside, or none
/// at
///   all
ORTUNG_API LearnArea learnArea(const SimWorld& world, double cell, const RobotSize& robot,
                               const std::optional<std::array<double, 2>>& inside = {});

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

#pragma once

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <vector>

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

/// The model learner (paper, section 5.2), a piece at a time: puts each sensor on the centre of
/// every open cell, in as many headings as it needs, generates noise-free data and calls
/// learnProbability. Features that are made of others learn what is made of those there. What is
/// learned does not depend on the number of threads. Not thread-safe.
class ORTUNG_API Learner {
 public:
  /// @param world, devices, factory borrowed @param devices of the robot that learns
  /// @param helpers the same devices of further robots of the same file, one set for each thread
  ///   that generates data; none: the caller's thread does it with @p devices
  /// @throws std::invalid_argument for a heading step that does not divide a turn, and for a
  /// feature
  ///   that nothing gives
  Learner(const World& world, const FieldRegion& region, const std::vector<Device>& devices,
          std::span<const std::vector<Device>> helpers, PluginFactory& factory,
          const LearnOptions& options);
  ~Learner();
  Learner(const Learner&) = delete;
  Learner& operator=(const Learner&) = delete;

  /// Learns at some cells more. @returns whether there are others left; if not, all features have
  /// learned
  bool step();
  /// Of all poses, in [0, 1].
  double share() const;
  /// Where the robot stood last, in the field frame.
  const Pose2& pose() const;
  /// In how many headings each feature is learned; 0: it needs no tables.
  struct Need {
    SensorId feature;
    std::size_t headings = 0;
  };
  const std::vector<Need>& needs() const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

/// Lets a robot learn all at once, by the caller's thread.
/// @throws as Learner
ORTUNG_API void learn(const World& world, const FieldRegion& region,
                      const std::vector<Device>& devices, PluginFactory& factory,
                      const LearnOptions& options);

}  // namespace ortung

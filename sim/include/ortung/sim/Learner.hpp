#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "ortung/base/Export.hpp"
#include "ortung/robot/RobotFile.hpp"
#include "ortung/robot/TableInfo.hpp"
#include "ortung/sim/SimWorld.hpp"
#include "ortung/sim_api/Sensor.hpp"

namespace ortung {

/// The resolution with which tables are learned.
struct LearnOptions {
  double cell = 0.1;                  ///< edge length of a cell [m]
  double headingStep = 0.0349065850;  ///< angle between headings [rad]; must divide a turn
};

/// The part of a world for which tables are learned.
struct LearnArea {
  /// Cells to learn; only the connected part of the floor, or of each floor of a building, that
  /// holds the robot is standable.
  FieldRegion region;
  double leftOut = 0.0;  ///< area of the other parts on which it could stand [m^2]
};
/// Returns the area to learn for a robot. Closed rooms, and the space outside of the walls within
/// their bounding box, are left out: no robot is there, but MCL would try such poses and might
/// believe them.
/// @param cell edge length of a cell [m]
/// @param inside a point [m] of the part to learn; nothing: the part that FieldParts::main()
///   chooses, of each floor
/// @throws std::invalid_argument as SimWorld::region(); if there is no room at @p inside, or none
/// at all
ORTUNG_API LearnArea learnArea(const SimWorld& world, double cell, const RobotSize& robot,
                               const std::optional<std::array<double, 2>>& inside = {});
/// The same for a part given as text: "auto", "all" (nothing is left out), or a point "x;y" [m].
/// @throws std::invalid_argument, also for another text
ORTUNG_API LearnArea learnAreaOf(const SimWorld& world, double cell, const RobotSize& robot,
                                 const std::string& part);
/// Returns how tables describe themselves that a robot of a file has learned in a world.
ORTUNG_API TableInfo tableInfoOf(const SimWorld& world, const RobotConfig& robot,
                                 const FieldRegion& region, const LearnOptions& options);

/// The model learner (paper, section 5.2), which works in steps: it puts each sensor on the centre
/// of every open cell, in as many headings as it needs, generates noise-free data and calls
/// learnProbability. Derived features learn what is extracted from their inputs there. The tables
/// do not depend on the number of threads. Not thread-safe.
///
/// The work can be cut: several learners of the same world and robot passOn() the readings of a
/// shard each, and one more takes all of them by learnFrom(). Generating readings is most of the
/// work. Since that learner does what step() does, with the same readings in the same order, its
/// tables have the same bits.
class ORTUNG_API Learner {
 public:
  /// Gets readings as words whose layout is the learner's own.
  using Readings = std::function<void(std::span<const std::uint32_t>)>;

  /// @param world, devices, factory borrowed @param devices of the robot that learns
  /// @param helpers the same devices of further robots of the same file, one set for each thread
  ///   that generates data; none: the caller's thread does it with @p devices
  /// @throws std::invalid_argument for a heading step that does not divide a turn, and for a
  ///   feature that no sensor or extractor provides
  Learner(const World& world, const FieldRegion& region, const std::vector<Device>& devices,
          std::span<const std::vector<Device>> helpers, PluginFactory& factory,
          const LearnOptions& options);
  ~Learner();
  Learner(const Learner&) = delete;
  Learner& operator=(const Learner&) = delete;

  /// Makes step() generate the readings of one shard only, and give them away instead of learning
  /// them. @pre step() was not called @param shard its number, from 1 @param shards how many there
  /// are; each has about the same number of readings
  void passOn(std::uint64_t shard, std::uint64_t shards, Readings take);
  /// Learns the readings that passOn() gave elsewhere: those of shard 1 first, each shard's in
  /// their order. @throws std::invalid_argument for others
  void learnFrom(std::span<const std::uint32_t> readings);
  /// Ends learning by learnFrom(). @throws std::invalid_argument if readings are missing
  void endLearning();

  /// Learns at some more cells. @returns whether cells are left; if not, all features have learned
  bool step();
  /// Returns the share of all poses that have been learned, in [0, 1].
  double share() const;
  /// Returns the robot's last pose in the field frame.
  const Pose2& pose() const;
  /// The number of headings in which a feature is learned; 0: it needs no tables.
  struct Need {
    SensorId feature;
    std::size_t headings = 0;
  };
  /// Returns the needs of all features that localize.
  const std::vector<Need>& needs() const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

/// Learns everything in one call, in the caller's thread.
/// @throws as Learner
ORTUNG_API void learn(const World& world, const FieldRegion& region,
                      const std::vector<Device>& devices, PluginFactory& factory,
                      const LearnOptions& options);

}  // namespace ortung

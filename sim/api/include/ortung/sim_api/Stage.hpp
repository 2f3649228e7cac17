#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "ortung/base/Export.hpp"
#include "ortung/base/Pose2.hpp"
#include "ortung/base/Random.hpp"
#include "ortung/base/Time.hpp"
#include "ortung/sim_api/Twist.hpp"
#include "ortung/sim_api/World.hpp"
#include "ortung/tables/FieldRegion.hpp"

namespace ortung {

/// Where a robot of one size can be, and how it gets there.
class ORTUNG_API FloorPlan {
 public:
  virtual ~FloorPlan();
  /// Corners of a short way, without its beginning; the last is the cell of @p to.
  virtual std::vector<FloorPoint> route(const FloorPoint& from, const FloorPoint& to) const = 0;
  /// A pose from which routes lead everywhere else, every cell and heading as likely.
  virtual Pose2 randomPose(Random& random) const = 0;
  virtual const FieldGrid& grid() const = 0;
  /// Indices of the grid's cells that belong to the free space.
  virtual const std::vector<std::uint32_t>& cells() const = 0;
};

/// A robot as it really is.
struct StagedRobot {
  std::string name;
  std::string team;     ///< "": none
  Pose2 pose;           ///< in the field frame
  Twist velocity;       ///< in the field frame
  double radius = 0.0;  ///< [m]
};

/// Something movable that is no robot, as it really is: a ball, a crate.
struct StagedThing {
  std::string name;
  std::string kind;
  Pose2 pose;      ///< in the field frame
  Twist velocity;  ///< in the field frame
};

/// The state of a simulated world, to look at and to change: for referees, for perfect players and
/// for situations that are made (paper, section 4). A real field has none. Robots and things are in
/// the order of their coming. Not thread-safe; what is returned is valid until the cycle is over.
class ORTUNG_API Stage {
 public:
  virtual ~Stage();

  virtual Timestamp now() const = 0;
  virtual double cycle() const = 0;  ///< [s]
  /// What sensors ask: bodies, lines, rays.
  virtual const World& world() const = 0;
  virtual std::span<const StagedRobot> robots() const = 0;
  virtual std::span<const StagedThing> things() const = 0;

  /// Carries a robot elsewhere, unnoticed by its odometry. @throws std::invalid_argument if there
  /// is no robot of this name, or no room (NoRoom)
  virtual void placeRobot(std::string_view robot, const Pose2& pose) = 0;
  /// Puts a thing somewhere, moving as given. @throws as placeRobot()
  virtual void placeThing(std::string_view thing, const Pose2& pose,
                          const Twist& velocity = {}) = 0;
  /// Of robots of a size; made when it is first asked for, and kept.
  /// @throws std::invalid_argument if such a robot fits nowhere
  virtual std::shared_ptr<const FloorPlan> floorPlan(const RobotSize& size) = 0;
};

}  // namespace ortung

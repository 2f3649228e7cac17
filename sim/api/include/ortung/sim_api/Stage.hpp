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

/// The floor that a robot of one size can reach, and routes on it.
class ORTUNG_API FloorPlan {
 public:
  virtual ~FloorPlan();
  /// Returns the corners of a short route [m], without its start; the last is the centre of the
  /// cell of @p to.
  virtual std::vector<FloorPoint> route(const FloorPoint& from, const FloorPoint& to) const = 0;
  /// Returns a random pose in the free space, with each cell and heading equally likely; routes
  /// lead from there to all other cells.
  virtual Pose2 randomPose(Random& random) const = 0;
  /// Returns the grid that the plan is made of.
  virtual const FieldGrid& grid() const = 0;
  /// Returns the indices of the grid's cells that belong to the free space.
  virtual const std::vector<std::uint32_t>& cells() const = 0;
};

/// The true state of a robot.
struct StagedRobot {
  std::string name;
  std::string team;     ///< name of its team; "": none
  Pose2 pose;           ///< pose in the field frame
  Twist velocity;       ///< velocity in the field frame
  double radius = 0.0;  ///< radius of the circle around its body [m]
};

/// The true state of something movable that is not a robot: a ball, a crate.
struct StagedThing {
  std::string name;
  std::string kind;  ///< "ball", "obstacle", ...
  Pose2 pose;        ///< pose in the field frame
  Twist velocity;    ///< velocity in the field frame
};

/// The true state of a simulated world, which can be read and changed: for referees, for players
/// with perfect sight and for prepared situations (paper, section 4). A real field has none. Robots
/// and things are in the order in which they were added. Not thread-safe; what is returned is valid
/// until the cycle is over.
class ORTUNG_API Stage {
 public:
  virtual ~Stage();

  /// Returns the simulated time [us].
  virtual Timestamp now() const = 0;
  /// Returns the length of a cycle [s].
  virtual double cycle() const = 0;
  /// Returns the world as sensors see it: bodies, lines, rays.
  virtual const World& world() const = 0;
  /// Return the true states of all robots and of all other movable things.
  virtual std::span<const StagedRobot> robots() const = 0;
  virtual std::span<const StagedThing> things() const = 0;

  /// Moves a robot to a pose in the field frame, unnoticed by its odometry. @throws
  /// std::invalid_argument if there is no robot of this name, or no room (NoRoom)
  virtual void placeRobot(std::string_view robot, const Pose2& pose) = 0;
  /// Moves a thing to a pose and gives it a velocity, both in the field frame. @throws as
  /// placeRobot()
  virtual void placeThing(std::string_view thing, const Pose2& pose,
                          const Twist& velocity = {}) = 0;
  /// Returns the plan for robots of a size; it is made at the first call, and kept.
  /// @throws std::invalid_argument if such a robot fits nowhere
  virtual std::shared_ptr<const FloorPlan> floorPlan(const RobotSize& size) = 0;
};

}  // namespace ortung

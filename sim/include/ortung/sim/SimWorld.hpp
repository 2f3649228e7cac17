#pragma once

#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "ortung/base/Export.hpp"
#include "ortung/sim/PhysicsConfig.hpp"
#include "ortung/sim/Primitive.hpp"
#include "ortung/sim/Solids.hpp"
#include "ortung/sim_api/World.hpp"
#include "ortung/tables/FieldRegion.hpp"

namespace ortung {

/// Something that moves: a robot, a ball, a crate.
struct MovingBody {
  std::string kind = "robot";
  std::string name;
  std::string colour;
  std::vector<Primitive> pieces;  ///< in the body's own frame; at least one
};

/// The simulated world: primitives and occupancy grids extruded in z, and bodies that move in it.
/// Moving bodies have numbers like robots, since rays ignore them by these.
/// Queries are thread-safe while nobody moves bodies.
class ORTUNG_API SimWorld : public World {
 public:
  ~SimWorld() override;
  virtual const std::string& name() const = 0;
  virtual const PhysicsConfig& physics() const = 0;
  virtual Solids solids() const = 0;
  /// The same place for another simulation, as it was read: nothing moves in it yet. What stands is
  /// shared, so it costs little; each may be used by a thread of its own.
  virtual std::unique_ptr<SimWorld> another() const = 0;
  /// What is movable, where it is at the beginning. It takes part once addBody() was called for it.
  virtual std::span<const Primitive> movables() const { return {}; }

  /// 16 hexadecimal digits over everything that shapes what sensors learn: not names, not comments,
  /// not the order in the file, nothing that moves.
  virtual std::string fingerprint() const = 0;

  /// The cells to learn: `open` where the centre is free up to the robot's height, `standable`
  /// where all of the robot is. Nothing that moves counts.
  /// @param cell edge of a cell [m], at least 0.001
  /// @throws std::invalid_argument for bad sizes and for more than 2^26 cells
  virtual FieldRegion region(double cell, const RobotSize& robot) const = 0;

  /// @throws std::invalid_argument for sizes outside [0.001, 100] m, for a pose that is not finite
  ///   and for more than 4096 bodies
  virtual RobotNumber addBody(const MovingBody& body, const Pose2& pose) = 0;
  /// @param velocity in the field frame, for sensors to see
  /// @throws std::invalid_argument for a body that is not there or a pose that is not finite
  virtual void moveBody(RobotNumber body, const Pose2& pose, const Twist& velocity = {}) = 0;
  /// Gives a body other pieces, in its own frame. @throws std::invalid_argument
  virtual void reshapeBody(RobotNumber body, std::span<const Primitive> pieces) = 0;
  /// Gives a robot the marker of a team, for cameras to see. @throws std::invalid_argument
  virtual void markBody(RobotNumber body, const std::string& team);
  /// Takes a body off the field; its number is not used again. @throws std::invalid_argument
  virtual void removeBody(RobotNumber body) = 0;
};

/// Reads a world file (TOML) and the maps that it names. @throws ConfigError
ORTUNG_API std::unique_ptr<SimWorld> readWorld(const std::filesystem::path& file);

}  // namespace ortung

#pragma once

#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "ortung/base/Export.hpp"
#include "ortung/base/Parameters.hpp"
#include "ortung/sim/PhysicsConfig.hpp"
#include "ortung/sim/Primitive.hpp"
#include "ortung/sim/Solids.hpp"
#include "ortung/sim_api/World.hpp"
#include "ortung/tables/FieldModel.hpp"
#include "ortung/tables/FieldRegion.hpp"

namespace ortung {

/// Something that moves: a robot, a ball, a crate.
struct MovingBody {
  std::string kind = "robot";
  std::string name;
  std::string colour;
  std::vector<Primitive> pieces;  ///< its pieces in the body's own frame; at least one
};

/// The simulated world: primitives and occupancy grids extruded in z, and bodies that move in it.
/// Moving bodies have numbers, by which rays can ignore them. Queries are thread-safe while bodies
/// are not moved.
class ORTUNG_API SimWorld : public World {
 public:
  ~SimWorld() override;
  virtual const std::string& name() const = 0;
  /// Returns the table [physics] of the world file.
  virtual const PhysicsConfig& physics() const = 0;
  /// Returns everything fixed that bodies can collide with.
  virtual Solids solids() const = 0;
  /// Returns a copy for another simulation, in its initial state without moving bodies. The fixed
  /// parts are shared, so it is cheap; each copy may be used by a thread of its own.
  virtual std::unique_ptr<SimWorld> another() const = 0;
  /// Returns the movable primitives at their initial poses. They take part once addBody() has been
  /// called for them.
  virtual std::span<const Primitive> movables() const { return {}; }

  /// Returns fieldModelOf() this world, which its copies may share.
  virtual std::shared_ptr<const FieldModel> field() const;
  /// Returns a digest of 16 hexadecimal digits over everything that determines what sensors learn:
  /// not names, comments, the order in the file, nor anything that moves.
  virtual std::string fingerprint() const = 0;

  /// Returns the cells to learn: `open` where the centre is free up to the robot's height,
  /// `standable` where the whole robot has room. Moving bodies are ignored.
  /// @param cell edge of a cell [m], at least 0.001
  /// @throws std::invalid_argument for bad sizes and for more than 2^26 cells
  virtual FieldRegion region(double cell, const RobotSize& robot) const = 0;

  /// Adds a moving body at a pose in the field frame. @returns its number
  /// @throws std::invalid_argument for sizes outside [0.001, 100] m, for a pose that is not finite
  ///   and for more than 4096 bodies
  virtual RobotNumber addBody(const MovingBody& body, const Pose2& pose) = 0;
  /// Moves a body to a pose in the field frame.
  /// @param velocity velocity in the field frame, which sensors see
  /// @throws std::invalid_argument for an unknown body or a pose that is not finite
  virtual void moveBody(RobotNumber body, const Pose2& pose, const Twist& velocity = {}) = 0;
  /// Replaces the pieces of a body, given in its own frame. @throws std::invalid_argument
  virtual void reshapeBody(RobotNumber body, std::span<const Primitive> pieces) = 0;
  /// Gives a robot the marker of a team, which cameras see. @throws std::invalid_argument
  virtual void markBody(RobotNumber body, const std::string& team);
  /// Removes a body; its number is not used again. @throws std::invalid_argument
  virtual void removeBody(RobotNumber body) = 0;
};

/// Reads a world file (TOML) and the maps that it names, or a grid map as a world of its own, with
/// what MapWorld.hpp says. @throws ConfigError
ORTUNG_API std::unique_ptr<SimWorld> readWorld(const std::filesystem::path& file);
/// Reads a world file that was parsed before. @param name its name if it says none
/// @param folder folder of the maps that it names @throws ConfigError
ORTUNG_API std::unique_ptr<SimWorld> readWorld(const Parameters& toml, const std::string& name,
                                               const std::filesystem::path& folder);
/// Returns whether a file is a grid map of one of the kinds that can be a world.
ORTUNG_API bool isGridMap(const std::filesystem::path& file);

}  // namespace ortung

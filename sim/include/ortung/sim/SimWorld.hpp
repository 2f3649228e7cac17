#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "ortung/container/Export.hpp"
#include "ortung/container/FieldRegion.hpp"
#include "ortung/sim/PhysicsConfig.hpp"
#include "ortung/sim_api/World.hpp"

namespace ortung {

/// The simulated world: primitives and occupancy grids extruded in z, and robots that move in it.
/// Queries are thread-safe while nobody moves robots.
class ORTUNG_API SimWorld : public World {
 public:
  ~SimWorld() override;
  virtual const std::string& name() const = 0;
  virtual const PhysicsConfig& physics() const = 0;

  /// 16 hexadecimal digits over everything that shapes what sensors see: not names, not comments,
  /// not the order in the file.
  virtual std::string fingerprint() const = 0;

  /// The cells to learn: `open` where the centre is free, `standable` where a circle of
  /// @p robotRadius around it is. Robots do not count, nor do bodies that begin above 2 m.
  /// @param cell edge of a cell [m], at least 0.001
  /// @throws std::invalid_argument for bad sizes and for more than 2^26 cells
  virtual FieldRegion region(double cell, double robotRadius) const = 0;

  /// Makes a robot whose body is an upright cylinder standing on the floor, which rays of other
  /// robots hit. It is nowhere until moveRobot() puts it somewhere.
  /// @param radius [m], @param height [m], both in [0.01, 100]
  /// @throws std::invalid_argument for other sizes and for more than 4096 robots
  virtual RobotNumber addRobot(double radius, double height) = 0;
  /// @throws std::invalid_argument for a robot that is not there or a pose that is not finite
  virtual void moveRobot(RobotNumber robot, const Pose2& pose) = 0;
  /// Takes a robot off the field; its number is not used again. @throws std::invalid_argument
  virtual void removeRobot(RobotNumber robot) = 0;
};

/// Reads a world file (TOML) and the maps that it names. @throws ConfigError
ORTUNG_API std::unique_ptr<SimWorld> readWorld(const std::filesystem::path& file);

}  // namespace ortung

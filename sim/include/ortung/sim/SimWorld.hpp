#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "ortung/container/Export.hpp"
#include "ortung/container/FieldRegion.hpp"
#include "ortung/sim_api/World.hpp"

namespace ortung {

/// The simulated world: primitives and occupancy grids extruded in z, and robots that move in it.
/// Queries are thread-safe while nobody moves robots.
class ORTUNG_API SimWorld : public World {
 public:
  virtual const std::string& name() const = 0;

  /// 16 hexadecimal digits over everything that shapes what sensors see (not names, not comments).
  virtual std::string fingerprint() const = 0;

  /// The cells to learn: `open` where a point is free, `standable` where a circle of
  /// @p robotRadius is.
  /// @param cell edge of a cell [m] @throws std::invalid_argument for too many cells (2^26)
  virtual FieldRegion region(double cell, double robotRadius) const = 0;

  /// Puts a cylinder into the world that rays of other robots hit.
  virtual RobotNumber addRobot(double radius, double height) = 0;
  virtual void moveRobot(RobotNumber robot, const Pose2& pose) = 0;
};

/// Reads a world file (TOML) and the maps that it names. @throws ConfigError
ORTUNG_API std::unique_ptr<SimWorld> readWorld(const std::filesystem::path& file);

}  // namespace ortung

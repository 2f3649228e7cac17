#pragma once

#include <memory>
#include <optional>

#include "ortung/base/Export.hpp"
#include "ortung/run/Robot.hpp"
#include "ortung/server/ServedWorld.hpp"

namespace ortung {

/// Robots whose readings can be weighed, for the commands of clients. Refusals are ServeErrors.
/// Thread-safe.
class ORTUNG_API PerceivingRobots {
 public:
  virtual ~PerceivingRobots();

  /// Which robot is meant where none is named, if there is such a one.
  virtual std::optional<RobotId> usual() const = 0;
  /// Whether there is but one side: then players, too, may know what any robot perceives.
  virtual bool isForAll() const = 0;
  /// A robot whose features have tables, with its present readings. Its container takes further
  /// ones meanwhile; all else of it stays as it is. @throws ServeError
  virtual std::shared_ptr<const Robot> perceiver(RobotId robot) const = 0;
};

}  // namespace ortung

#pragma once

#include <map>
#include <memory>

#include "ortung/base/Export.hpp"
#include "ortung/sim/RoutePlanner.hpp"

namespace ortung {

/// Plans of the floor for robots of several sizes, each made when it is first needed. Not
/// thread-safe.
class ORTUNG_API FloorPlans {
 public:
  /// @param world borrowed
  explicit FloorPlans(const SimWorld& world) : world_(world) {}

  /// Returns the plan for robots of a size, and makes it if there is none yet.
  /// @throws std::invalid_argument if such a robot fits nowhere
  std::shared_ptr<const RoutePlanner> of(const RobotSize& size);
  /// Returns whether the plan for a size has been made.
  bool has(const RobotSize& size) const { return plans_.contains(size); }
  /// Drops the plan for a size; those who use it keep it alive.
  void forget(const RobotSize& size) { plans_.erase(size); }

 private:
  const SimWorld& world_;
  std::map<RobotSize, std::shared_ptr<const RoutePlanner>> plans_;
};

}  // namespace ortung

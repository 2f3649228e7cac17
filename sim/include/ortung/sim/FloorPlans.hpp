#pragma once

#include <map>
#include <memory>

#include "ortung/base/Export.hpp"
#include "ortung/sim/RoutePlanner.hpp"

namespace ortung {

/// Plans of the floor for robots of several sizes, each made when it is first asked for. Not
/// thread-safe.
class ORTUNG_API FloorPlans {
 public:
  /// @param world borrowed
  explicit FloorPlans(const SimWorld& world) : world_(world) {}

  /// @throws std::invalid_argument if such a robot fits nowhere
  std::shared_ptr<const RoutePlanner> of(const RobotSize& size);
  bool has(const RobotSize& size) const { return plans_.contains(size); }
  /// Who uses the plan keeps it.
  void forget(const RobotSize& size) { plans_.erase(size); }

 private:
  const SimWorld& world_;
  std::map<RobotSize, std::shared_ptr<const RoutePlanner>> plans_;
};

}  // namespace ortung

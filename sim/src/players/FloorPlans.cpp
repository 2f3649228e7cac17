#include "ortung/sim/FloorPlans.hpp"

namespace ortung {

std::shared_ptr<const RoutePlanner> FloorPlans::of(const RobotSize& size) {
  const auto known = plans_.find(size);
  if (known != plans_.end()) return known->second;
  return plans_[size] = std::make_shared<const RoutePlanner>(world_, size);
}

}  // namespace ortung

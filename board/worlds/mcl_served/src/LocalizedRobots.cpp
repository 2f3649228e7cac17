#include "ortung/mcl_served/LocalizedRobots.hpp"

#include <array>

namespace ortung {

PerceivingRobots::~PerceivingRobots() = default;
LocalizedRobots::~LocalizedRobots() = default;

const char* nameOf(LocalizationState::Kind kind) {
  constexpr std::array<const char*, 5> kNames = {"off", "learning", "searching", "running",
                                                 "failed"};
  return kNames[static_cast<std::size_t>(kind)];
}

}  // namespace ortung
